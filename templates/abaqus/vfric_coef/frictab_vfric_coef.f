C     VFRIC_COEF for Abaqus/Explicit, general contact (*FRICTION,
C     USER=COEFFICIENT): fCoef = tau_R/pressure of the
@{head}
@{arguments}
C
C     All that is computed is double precision, whatever the solver's
C     precision.
      double precision x(@{n_x}), press, speed, coef, ftcoef
      external ftcoef
@if unknown
      double precision ftqnan
      external ftqnan
@end
C
@{reads_once}
      do k = 1, nBlock
        do i = 1, 3
          fCoefDeriv(k,i) = 0
        end do
        press = pressure(k)
        speed = slipRate(k)
@if scaled
C       The process is this many times slower than the simulation.
        if (nProps .ge. @{scale}) speed = speed/props(@{scale})
@end
@{reads_point}
        coef = ftcoef(x, press, speed)
        fCoef(k) = real(coef, kind(fCoef))
      end do
      return
      end
C
C     tau_R/pressure in double precision; pressure and speed in the
C     solver's units, what else x holds comes from the entry.
      double precision function ftcoef(x, given, speed)
      implicit none
      double precision x(@{n_x}), given, speed, press, tau, fttau
      logical ftnan
      external fttau, ftnan
@if refuses
      double precision ftqnan
      logical ftstop
      external ftqnan, ftstop
@end
C     NaN first: nothing below compares with one.
      if (ftnan(given)) then
        ftcoef = given
        return
      else if (ftnan(speed)) then
        ftcoef = speed
        return
      end if
      press = given@{stress_convert}
C     Neither 0/0 nor inf/inf.
      if (press .lt. @{least}) press = @{least}
      if (press .gt. 1.0D30) press = 1.0D30
@{reads}
      tau = fttau(x)
@if refuses
C     Out of contact nothing is refused.
      if (given .gt. 0.0D0) then
        if (ftstop(x)) tau = ftqnan()
      end if
@end
      ftcoef = tau
      if (ftnan(tau)) return
      if (tau .lt. 0.0D0) tau = 0.0D0
      ftcoef = min(tau/press, @{most})
      return
      end
C
@{core}
