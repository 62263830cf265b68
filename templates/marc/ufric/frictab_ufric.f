C     UFRIC for Marc and Simufact Forming (friction by user routine):
C     @{result_name}, @{from}.
@{head}
C     NaN in gives NaN out.
C
C     @{result...}
C     There is no history: Marc gives this routine no state variables.
C     What it does not give is a constant, COMMON /FTCONS/ CST, filled
C     in BLOCK DATA FTDATA below.
C     @{source...}
C
@{arguments}
C
      double precision x(@{n_x}), press, flow, speed
      double precision ftcoef
      external ftcoef
      integer i
@{common}
@if directs
      double precision ftfold
      external ftfold
@end
@if guards_pressure
      logical ftnan
      external ftnan
@end
@if refuses
      logical ftstop
      double precision ftqnan
      external ftstop, ftqnan
@end
C
C     Magnitudes: the sign of FN is not relied upon.
      press = abs(fn)@{stress_convert}
      flow = yiel@{stress_convert}
      speed = 0.0D0
      do i = 1, @{n_slip}
        speed = speed + vrel(i)*vrel(i)
      end do
      speed = sqrt(speed)
@if by_force
C     FN is a force; the coefficient is the same at every pressure.
@end
@{reads}
@if by_force
@if coulomb
C     tau/p at any pressure.
      if (.not. ftnan(press)) press = 1.0D0
@end
@end
@if refuses
C     Without pressure there is nothing to look up.
      if (.not. ftnan(press)) then
        if (press .gt. 0.0D0) then
          if (ftstop(x)) then
            fric = ftqnan()
            return
          end if
        end if
      end if
@end
      fric = ftcoef(x, press, flow)
      return
      end
C
@{constants}
@{direction_text}
@{coefficient}
@{core}
