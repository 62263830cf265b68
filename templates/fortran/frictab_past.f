C     Histories of the law, h(1..@{n}), beside slip, work and peak
C     pressure: the law's states x from what they are before the
C     increment, and the pressure p, speed v and temperature t now.
      subroutine ftpast(h, p, v, t, x)
      implicit none
      double precision h(@{n}), p, v, t, x(*)
@if has_most
      double precision ftmost
      external ftmost
@end
@if has_mean
      double precision ftmean
      external ftmean
@end
@if has_ratio
      double precision ftrat
      external ftrat
@end
@if has_rise
      double precision ftrise
      external ftrise
@end
@for in in inputs
C     @{in.comment}
@if in.is_mean
      x(@{in.index}) = ftmean(h(@{in.state}), h(@{in.time}), @{in.of})@{in.convert}
@else
@if in.is_peak
@if in.shifts
      x(@{in.index}) = ftmost(h(@{in.state}), @{in.of}@{in.above})
      x(@{in.index}) = x(@{in.index})@{in.below}
@else
      x(@{in.index}) = ftmost(h(@{in.state}), @{in.of})@{in.convert}
@end
@else
@if in.is_ratio
      x(@{in.index}) = ftrat(p, ftmost(h(@{in.state}), p))
@else
@if in.is_rise
      x(@{in.index}) = ftrise(h(@{in.state}), t)
@else
@if in.is_lag
      x(@{in.index}) = t - ftmean(h(@{in.state}), h(@{in.time}), t)
@else
      x(@{in.index}) = h(@{in.state})@{in.convert}
@end
@end
@end
@end
@end
@end
      return
      end
C
C     They behind the increment, h1: of slip ds and time dt, under the
C     frictional stress tau; pmax: the peak pressure so far.
      subroutine ftnext(h, p, v, t, pmax, tau, ds, dt, h1)
      implicit none
      double precision h(@{n}), p, v, t, pmax, tau, ds, dt, h1(@{n})
@if has_most
      double precision ftmost
      external ftmost
@end
@if has_rise
      double precision ftfrst
      external ftfrst
@end
@if asks_nan
      logical ftnan
      external ftnan
@end
@for in in inputs
C     @{in.comment}
@if in.is_sum
      h1(@{in.state}) = h(@{in.state})
      if (ds .gt. 0.0D0) h1(@{in.state}) = h(@{in.state}) + p*ds
@end
@if in.is_time
      h1(@{in.state}) = h(@{in.state}) + dt
@end
@if in.is_dwell
      h1(@{in.state}) = h(@{in.state})
      if (ftnan(pmax)) then
        h1(@{in.state}) = pmax
      else if (p .ge. 0.5D0*pmax) then
        h1(@{in.state}) = h(@{in.state}) + dt
      end if
@end
@if in.is_ratio
      h1(@{in.state}) = ftmost(h(@{in.state}), p)
@end
@if in.is_since
      h1(@{in.state}) = h(@{in.state})
      if (ds .gt. 0.0D0) h1(@{in.state}) = h(@{in.state}) + ds
      if (ftnan(pmax)) then
        h1(@{in.state}) = pmax
      else if (p .ge. @{in.at_peak}*pmax) then
        h1(@{in.state}) = 0.0D0
      end if
@end
@if in.is_rise
      h1(@{in.state}) = ftfrst(h(@{in.state}), t)
@end
@if in.sums_mean
      h1(@{in.state}) = h(@{in.state})
      if (dt .gt. 0.0D0) h1(@{in.state}) = h(@{in.state}) + @{in.of}*dt
@end
@if in.is_peak
      h1(@{in.state}) = ftmost(h(@{in.state}), @{in.of}@{in.above})
@end
@if in.is_last
      h1(@{in.state}) = 0.0D0
@if in.is_flash
      if (v .gt. 0.0D0) h1(@{in.state}) = tau*sqrt(v@{in.speed})
@else
      if (v .gt. 0.0D0) h1(@{in.state}) = tau*v
@end
@end
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
@if in.is_mean
      if (h(@{in.time}) .le. 0.0D0) d@{in.of} = d@{in.of} + dy(@{in.index})
@end
@if in.is_peak
      if (@{in.of}@{in.above} .gt. h(@{in.state})) d@{in.of} = d@{in.of} + dy(@{in.index})
@end
@if in.is_ratio
      if (h(@{in.state}) .gt. p) dp = dp + dy(@{in.index})/(h(@{in.state})@{in.pressure})
@end
@if in.is_rise
      if (h(@{in.state}) .gt. 0.0D0) dt = dt + dy(@{in.index})
@end
@if in.is_lag
      if (h(@{in.time}) .gt. 0.0D0) dt = dt + dy(@{in.index})
@end
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
