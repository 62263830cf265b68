C     Histories of the law, h(1..@{n}), beside slip, work and peak
C     pressure: the law's states x from what they are before the
C     increment, and the pressure p, speed v and temperature t now.
@if has_area
C     a: the area now.
@end
      subroutine ftpast(h, p, v, t@{a}, x)
      implicit none
      double precision h(@{n}), p, v, t@{a}, x(*)
@for function in now_calls
      double precision @{function.text}
      external @{function.text}
@end
@for in in inputs
C     @{in.comment}
@{in.now}
@end
      return
      end
C
C     They behind the increment, h1: of slip ds and time dt, under the
C     frictional stress tau; pmax: the peak pressure so far.
      subroutine ftnext(h, p, v, t@{a}, pmax, tau, ds, dt, h1)
      implicit none
      double precision h(@{n}), p, v, t@{a}, pmax, tau, ds, dt, h1(@{n})
@for function in next_calls
      double precision @{function.text}
      external @{function.text}
@end
@if asks_nan
      logical ftnan
      external ftnan
@end
@for in in inputs
C     @{in.comment}
@{in.next}
@end
@if time_of_its_own
C     time that means are taken over
      h1(@{time}) = h(@{time}) + dt
@end
      return
      end
C
@if gradient
C     What peaks that are the present value, and means over no time
C     yet, add to the derivatives of the law (dy, by its states).
      subroutine ftlive(h, p, v, t, dy, dp, dv, dt)
      implicit none
      double precision h(@{n}), p, v, t, dy(*), dp, dv, dt
@for in in inputs
@{in.slope}
@end
      return
      end
C
@end
@if has_ratio
C     A load over its peak; 1 before there was one.
      double precision function ftrat(p, peak)
      implicit none
      double precision p, peak
      logical ftnan
      external ftnan
      ftrat = peak
      if (ftnan(peak)) return
      ftrat = 1.0D0
      if (peak .gt. 0.0D0) ftrat = p/peak
      return
      end
C
@end
@if has_turn
C     The extreme pressure h since the load last turned, behind the
C     pressure p: the highest while it rises, minus the lowest while it
C     falls. It turns where it is 5 % from that. NaN where one is.
      double precision function ftturn(h, p)
      implicit none
      double precision h, p
      logical ftnan
      external ftnan
      ftturn = h
      if (ftnan(h)) return
      ftturn = p
      if (ftnan(p)) return
      if (h .ge. 0.0D0 .and. p .lt. @{at_peak}*h) then
        ftturn = -p
      else if (h .ge. 0.0D0) then
        ftturn = max(h, p)
      else if (@{at_peak}*p .le. -h) then
        ftturn = max(h, -p)
      end if
      return
      end
C
C     1 while the load rises, 0 while it falls; NaN where h is.
      double precision function ftrsng(h)
      implicit none
      double precision h
      logical ftnan
      external ftnan
      ftrsng = h
      if (ftnan(h)) return
      ftrsng = 0.0D0
      if (h .ge. 0.0D0) ftrsng = 1.0D0
      return
      end
C
@end
@if has_rise
C     The temperature at the start of contact, in K: that of now where
C     there was none; NaN where one is.
      double precision function ftfrst(start, now)
      implicit none
      double precision start, now
      logical ftnan
      external ftnan
      ftfrst = start
      if (ftnan(start)) return
      if (start .le. 0.0D0) ftfrst = now + 273.15D0
      return
      end
C
C     How far it is above that; 0 in the first increment.
      double precision function ftrise(start, now)
      implicit none
      double precision start, now
      logical ftnan
      external ftnan
      ftrise = start
      if (ftnan(start)) return
      ftrise = now
      if (ftnan(now)) return
      ftrise = 0.0D0
      if (start .gt. 0.0D0) ftrise = now - (start - 273.15D0)
      return
      end
C
@end
@if has_most
C     The larger of both; NaN where one is.
      double precision function ftmost(a, b)
      implicit none
      double precision a, b
      logical ftnan
      external ftnan
      ftmost = a
      if (ftnan(a)) return
      ftmost = b
      if (ftnan(b)) return
      ftmost = max(a, b)
      return
      end
C
@end
@if has_mean
C     A mean over no time yet is the value now; NaN where that is one,
C     so that a state with it is never kept.
      double precision function ftmean(total, time, now)
      implicit none
      double precision total, time, now
      logical ftnan
      external ftnan
      ftmean = now
      if (ftnan(now)) return
      if (ftnan(time)) then
        ftmean = time
      else if (time .gt. 0.0D0) then
        ftmean = total/time
      end if
      return
      end
C
@end
@if has_recent
C     A speed h that follows v, by an n-th of what they differ in each
C     increment; v where there was none yet. NaN where one is.
      double precision function ftlate(h, v, n)
      implicit none
      double precision h, v, n
      logical ftnan
      external ftnan
      ftlate = h
      if (ftnan(h)) return
      ftlate = v
      if (ftnan(v)) return
      if (h .gt. 0.0D0) ftlate = h + (v - h)/n
      return
      end
C
@end
@if has_area
C     An area a over that at the first contact; 1 in the first
C     increment of it. NaN where one is.
      double precision function ftgrow(first, a)
      implicit none
      double precision first, a
      logical ftnan
      external ftnan
      ftgrow = first
      if (ftnan(first)) return
      ftgrow = a
      if (ftnan(a)) return
      ftgrow = 1.0D0
      if (first .gt. 0.0D0) ftgrow = a/first
      return
      end
C
@end
@if has_theta
C     A state of rate-and-state friction (@{time_unit}): that of sliding at v
C     (mm/@{time_unit}) for long, over the distance d (mm), where there was none.
C     There is none (0) before the contact first slides.
      double precision function ftthta(theta, v, d)
      implicit none
      double precision theta, v, d
      logical ftnan
      external ftnan
      ftthta = theta
      if (ftnan(theta)) return
      ftthta = v
      if (ftnan(v)) return
      ftthta = theta
      if (theta .le. 0.0D0) ftthta = d/max(v, @{slowest})
      return
      end
C
@end
@if has_aging
C     It behind a time dt, by the aging law.
      double precision function ftaged(theta, v, dt, d)
      implicit none
      double precision theta, v, dt, d, x, ftthta
      external ftthta
      ftaged = 0.0D0
      if (theta .le. 0.0D0 .and. v .le. @{slowest}) return
      ftaged = ftthta(theta, v, d)
      if (.not. dt .gt. 0.0D0) return
      x = max(v, 0.0D0)*dt/d
      if (x .gt. 1.0D-8) then
        ftaged = ftaged*exp(-x) + dt*(1.0D0 - exp(-x))/x
      else
        ftaged = ftaged*exp(-x) + dt
      end if
      return
      end
C
@end
@if has_slipping
C     It behind a time dt, by the slip law.
      double precision function ftslpd(theta, v, dt, d)
      implicit none
      double precision theta, v, dt, d, c, ftthta
      external ftthta
      ftslpd = 0.0D0
      if (theta .le. 0.0D0 .and. v .le. @{slowest}) return
      ftslpd = ftthta(theta, v, d)
      if (.not. dt .gt. 0.0D0) return
      c = log(d/max(v, @{slowest}))
      ftslpd = exp(c + (log(ftslpd) - c)*exp(-max(v, 0.0D0)*dt/d))
      return
      end
C
@end
