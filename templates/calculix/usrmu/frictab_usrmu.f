C     USRMU for CalculiX, by calls put into its source: friction
C     coefficient mu, @{from}.
@{head}
C     NaN in gives NaN out.
C
C     UM: mu = tau_R/p. Below @{least} MPa it is mu of that pressure,
C     and at most @{most}.
C     What CalculiX does not give is a constant, COMMON /FTCONS/ CST,
C     filled in BLOCK DATA FTDATA below. Threads may call it at once.
C     @{source...}
C
C     PRES: pressure. AL: relative displacement since the start of the
C     increment, VAL its part along the normal XN. T: tangential
C     displacement since first contact. T1L: temperature. UM comes in as
C     the number of *FRICTION and stays so without contact.
      subroutine usrmu(um, pres, al, xn, val, t, t1l)
      implicit none
      double precision um, pres, al(3), xn(3), val, t(3), t1l
C
      double precision x(@{n_x}), press, speed, slide, ftcoef
      external ftcoef
      integer i
      double precision dtime
      common /fttime/ dtime
@{common}
@if directs
      double precision way(3), ftturn
      external ftturn
@end
      logical ftnan, warm
      external ftnan
@if refuses
      logical ftstop
      double precision ftqnan
      external ftstop, ftqnan
@end
C
C     NaN first: nothing below compares with one.
      if (.not. ftnan(pres)) then
        if (pres .le. 0.0D0) return
      end if
      warm = .true.
      if (.not. ftnan(t1l)) warm = abs(t1l) .gt. 0.0D0
      press = pres@{stress_convert}
      speed = 0.0D0
      slide = 0.0D0
      do i = 1, 3
        speed = speed + (al(i) - val*xn(i))**2
@if directs
        way(i) = al(i) - val*xn(i)
@end
        slide = slide + t(i)*t(i)
      end do
      speed = sqrt(speed)
      slide = sqrt(slide)
      if (dtime .gt. 0.0D0) then
        speed = speed/dtime
      else
        speed = 0.0D0
      end if
@{reads}
@if refuses
      if (.not. ftnan(press)) then
        if (ftstop(x)) then
          um = ftqnan()
          return
        end if
      end if
@end
      um = ftcoef(x, press, 0.0D0)
      return
      end
C
C     The time increment, which the contact springs are not given. Every
C     thread says the same number.
      subroutine usrmu_time(dt)
      implicit none
      double precision dt, dtime
      common /fttime/ dtime
      dtime = dt
      return
      end
C
@{constants}
@{direction_text}
@{coefficient}
@{core}
