@if in_space
C     Angle in degrees of a slip on the surface of this normal, from the
C     reference direction laid on the surface; counter-clockwise as
C     seen along the normal.
      double precision function ftturn(slip, normal)
      implicit none
      double precision slip(3), normal(3), to(3), tilt, along, across
      double precision ftfold
      external ftfold
      integer i
      to(1) = @{reference_1}
      to(2) = @{reference_2}
      to(3) = @{reference_3}
      tilt = to(1)*normal(1) + to(2)*normal(2) + to(3)*normal(3)
      along = 0.0D0
      do i = 1, 3
        along = along + slip(i)*(to(i) - tilt*normal(i))
      end do
      across = slip(1)*(to(2)*normal(3) - to(3)*normal(2))
     &  + slip(2)*(to(3)*normal(1) - to(1)*normal(3))
     &  + slip(3)*(to(1)*normal(2) - to(2)*normal(1))
      ftturn = ftfold(along, across)
      return
      end
C
@end
C     Angle in degrees of a vector with these components, 0 if both are,
C     in the turn from @{low_text} to @{high_text}. NaN gives NaN.
      double precision function ftfold(along, across)
      implicit none
      double precision along, across, degree
      logical ftnan
      external ftnan
      parameter (degree = 57.29577951308232D0)
      ftfold = along + across
      if (ftnan(ftfold)) return
      ftfold = 0.0D0
      if (abs(along) + abs(across) .gt. 0.0D0)
     &  ftfold = degree*atan2(across, along)
      ftfold = @{low} + modulo(ftfold - (@{low}), @{period})
      return
      end
C
