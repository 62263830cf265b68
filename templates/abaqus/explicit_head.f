C     frictional shear stress tau_R @{from}.
@{head}
C
C     PROPS (PROPERTIES=@{n_props}; a property the deck does not give
C     takes the value in brackets):
@for line in properties
C     @{line.text}
@end
C
@for line in remarks
C     @{line.text}
@end
C
C     Argument list:
@for line in source
C     @{line.text}
@end
C
