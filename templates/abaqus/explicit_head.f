C     frictional shear stress tau_R @{from}.
@{head}
C
@include abaqus/properties.f
C     @{remarks...}
C
C     Argument list:
C     @{source...}
C
