C     frictional shear stress tau_R @{from}.
@{head}
C
@include abaqus/properties.f
@for line in remarks
C     @{line.text}
@end
C
C     Argument list:
@for line in source
C     @{line.text}
@end
C
