@if coulomb
C     mu = tau_R/p of the state x at the pressure press (MPa). Below
C     @{least} MPa it is that of @{least} MPa: at 0 it would be 0/0.
C     Above 1E30 it is that of 1E30. At most @{most}.
@else
@if shear
C     m = tau_R/k of the state x, k = flow/sqrt(3) (MPa). 0 without
C     pressure or without flow stress. At most @{most}.
@else
C     tau_R in MPa of the state x; 0 without pressure.
@end
@end
      double precision function ftcoef(x, press, flow)
      implicit none
      double precision x(@{n_x}), press, flow
      double precision fttau
      logical ftnan
      external fttau, ftnan
@if coulomb
      double precision y(@{n_x}), p
      integer i
@end
      if (ftnan(press)) then
        ftcoef = press
        return
      end if
@if shear
      if (ftnan(flow)) then
        ftcoef = flow
        return
      end if
@end
@if coulomb
      p = press
      if (p .lt. @{least}) p = @{least}
      if (p .gt. 1.0D30) p = 1.0D30
      do i = 1, @{n_x}
        y(i) = x(i)
      end do
@if takes_pressure
      y(@{pressure}) = p
@end
      ftcoef = fttau(y)/p
@else
      ftcoef = 0.0D0
@if shear
      if (press .gt. 0.0D0 .and. flow .gt. 0.0D0)
     &  ftcoef = fttau(x)/(flow*0.5773502691896258D0)
@else
      if (press .gt. 0.0D0) ftcoef = fttau(x)
@end
@end
@if capped
      if (.not. ftnan(ftcoef)) ftcoef = min(ftcoef, @{most})
@end
      return
      end
C
