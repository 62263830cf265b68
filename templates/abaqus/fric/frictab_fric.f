C     FRIC for Abaqus/Standard (*FRICTION, USER): frictional stress
C     with its derivatives, limit tau_R @{from}.
@{head}
C     @{coefficient...}
C     Below @{smallest} MPa the coefficient tau_R/p is that at @{smallest} MPa,
C     so that friction begins at 0 with the pressure.
C     NaN in gives NaN in TAU; STATEV stay as they were.
C
C     Stick is elastic: TAU = tau_R/gc * elastic slip, up to the
C     critical elastic slip gc; beyond it the point slips under tau_R,
C     along its slip. gc is property @{critical}, else 0.005*CHRLNGTH.
C
@include abaqus/properties.f
C     STATEV (DEPVAR=@{depvar}), by contact point, at the end of the increment:
C     1 accumulated slip under pressure (@{length}), 2 friction work per
C     area (@{stress}*@{length}), 3 peak pressure (@{stress}), 4 increments in which
C     the state was outside the range, 5 and 6 elastic slip (@{length}),
C     7 coefficient tau_R/p, @{stamp} the increment these belong to,
C     @{first} to @{depvar} numbers 1 to @{n_states} at its start.
C     @{histories...}
C     With fewer there is no history: slip and work count as 0, the
C     peak pressure is the pressure, elastic slip follows from TAU.
C
C     DDTDDP and the coupling of directions are not symmetric: *STEP,
C     UNSYMM=YES.
C     @{source...}
C
@{arguments}
C
C     Canonical units (MPa, mm) in x, y, dy and what is named so.
      double precision x(@{n_x}), dy(@{n_x}), y, pmpa, peval
C     History at the start and at the end of this increment
      double precision s0(@{n_states}), s1(@{n_states})
C     Relative motion, its direction, elastic slip, trial elastic slip
      double precision dg(2), e(2), ge(2), gt(2)
C     The limit in the solver's units and its derivatives; a direction,
C     and what TAU changes by per change of the limit
      double precision flim, flimp, flimv, flims, flimt, w(2), wl(2)
      double precision p, gc, dgn, gtn, gain, speed, vrate, ds
      double precision dp, dpeak, loss, along
      double precision amu, hold, ftsize, zero, unit
      logical keeps, bad, slips
      double precision ftqnan
      external ftqnan
      logical ftnan
      external ftnan, ftsize
@include fortran/range_checks.f
@if has_histories
C     What histories add to the derivatives by speed and temperature
      double precision hv, ht
@end
@if directs
C     The direction of slip, its square, the limit's derivative by the
C     angle (per radian), and the angle's by the motion
      double precision way(2), way2, flimd, turn(2), degree, ftfold
      external ftfold
      parameter (degree = 57.29577951308232D0)
@end
      parameter (zero = 0.0D0)
C
      keeps = nstatv .ge. @{depvar}
      do i = 1, @{n_states}
        s0(i) = zero
      end do
      if (keeps) call ftbegn(statev, kstep, kinc, s0)
C
C     Open at the end of the last increment: no friction in this one,
C     and nothing is stretched any more.
      if (lm .eq. 2) then
        s0(5) = zero
        s0(6) = zero
        s0(7) = zero
        if (keeps) call ftkeep(statev, kstep, kinc, s0, s0)
        return
      end if
C
C     NaN first: nothing below compares with one.
      lm = 0
      p = press
      speed = dtime
      gc = chrlngth
      hold = zero
      if (nprops .ge. @{critical}) hold = props(@{critical})
      bad = ftnan(p)
      if (ftnan(speed)) bad = .true.
      if (ftnan(gc)) bad = .true.
      if (ftnan(hold)) bad = .true.
      do i = 1, @{n_states}
        if (ftnan(s0(i))) bad = .true.
      end do
      do i = 1, 2
        dg(i) = zero
        ge(i) = zero
        e(i) = zero
      end do
      do i = 1, nfdir
        dg(i) = dgam(i)
        if (.not. keeps) ge(i) = tau(i)
        if (ftnan(dg(i))) bad = .true.
        if (ftnan(ge(i))) bad = .true.
      end do
      sed = zero
      sfd = zero
      do i = 1, nfdir
        tau(i) = zero
        if (bad) tau(i) = ftqnan()
        dslip(i) = zero
        ddtddp(i) = zero
        ddtddt(i,1) = zero
        ddtddt(i,2) = zero
        do j = 1, nfdir
          ddtddg(i,j) = zero
        end do
      end do
      if (bad) return
C
C     No friction without pressure.
      if (p .le. zero) then
        do i = 1, @{n_states}
          s1(i) = s0(i)
        end do
        s1(5) = zero
        s1(6) = zero
        if (keeps) call ftkeep(statev, kstep, kinc, s0, s1)
        return
      end if
C
C     What is larger than 1D30 is as good as infinite.
      p = min(p, 1.0D30)
      pmpa = p@{to_mpa}
      peval = max(pmpa, @{pmin})
      do i = 1, nfdir
        dg(i) = max(-1.0D30, min(dg(i), 1.0D30))
      end do
      dgn = ftsize(dg)
      speed = zero
      vrate = zero
      if (dtime .gt. zero) then
        if (dgn .lt. dtime*1.0D30) then
          speed = dgn/dtime
          if (dgn .gt. zero) vrate = 1.0D0/dtime
        else
          speed = 1.0D30
        end if
      end if
      if (dgn .gt. zero) then
        e(1) = dg(1)/dgn
        e(2) = dg(2)/dgn
      end if
C
C     Critical elastic slip
      gc = 0.005D0*chrlngth
      if (hold .gt. zero) gc = hold
      if (gc .le. zero) gc = @{least_slip}
C
C     Trial: all motion is elastic. DROT turns components that the
C     solver does not turn itself.
      ds = zero
      gt(1) = zero
      gt(2) = zero
      if (keeps) then
        ge(1) = s0(5)
        if (nfdir .eq. 2) then
          ge(1) = drot(1,1)*s0(5) + drot(1,2)*s0(6)
          ge(2) = drot(2,1)*s0(5) + drot(2,2)*s0(6)
        end if
        gt(1) = ge(1) + dg(1)
        gt(2) = ge(2) + dg(2)
        gtn = ftsize(gt)
        bad = ftnan(gtn)
        if (.not. bad) ds = max(gtn - gc, zero)
      end if
C
@if directs
C     A point slips along its trial elastic slip; without history, along
C     the motion.
      way(1) = dg(1)
      way(2) = dg(2)
      if (keeps) then
        way(1) = gt(1)
        way(2) = gt(2)
      end if
C
@end
C     The law's states
@{reads}
@if has_histories
      do i = 1, @{n_x}
        dy(i) = zero
      end do
      call ftpast(s0(8), p, speed, @{temperature_now}, x)
@end
@if refuses
      if (ftstop(x)) then
        y = ftqnan()
      else
        call ftgrad(x, y, dy)
      end if
@else
      call ftgrad(x, y, dy)
@end
      if (ftnan(y)) bad = .true.
      if (bad) then
        do i = 1, nfdir
          tau(i) = ftqnan()
        end do
        return
      end if
C
C     The limit and its derivatives
      amu = y/peval
      dp = zero
      dpeak = zero
      flimv = zero
      flims = zero
      flimt = zero
@if directs
      flimd = zero
@end
@{slopes}
@if has_histories
      hv = zero
      ht = zero
      call ftlive(s0(8), p, speed, @{temperature_now}, dy, dpeak, hv, ht)
      flimv = flimv + hv@{to_solver}@{to_mm_s}
@if knows_temperature
      flimt = flimt + ht@{to_solver}
@end
@end
      if (pmpa .ge. peval) then
        flim = y@{to_solver}
        flimp = dp + dpeak
      else
        hold = pmpa/peval
        flim = y*hold@{to_solver}
        flimp = amu + dpeak*hold
        flimv = flimv*hold
        flims = flims*hold
        flimt = flimt*hold
@if directs
        flimd = flimd*hold
@end
      end if
@if frozen
C     The coefficient that the last increment left, where there is one
      if (keeps .and. s0(7) .gt. zero) then
        flim = s0(7)*p
        flimp = s0(7)
        flimv = zero
        flims = zero
        flimt = zero
@if directs
        flimd = zero
@end
      end if
@end
@if directs
C     The angle turns with what of the motion is across the slip.
      turn(1) = zero
      turn(2) = zero
      way2 = way(1)*way(1) + way(2)*way(2)
      if (way2 .gt. zero) then
        turn(1) = -way(2)/way2
        turn(2) = way(1)/way2
      end if
@end
C
C     Without history: the elastic slip that TAU stands for
      loss = zero
      if (.not. keeps) then
        gain = zero
        if (flim .gt. zero) then
          gain = gc/flim
          hold = ftsize(ge)
          loss = 1.0D0
          if (hold .gt. flim) then
            gain = gc/hold
            loss = zero
          end if
        end if
        ge(1) = ge(1)*gain
        ge(2) = ge(2)*gain
        gt(1) = ge(1) + dg(1)
        gt(2) = ge(2) + dg(2)
        gtn = ftsize(gt)
        ds = max(gtn - gc, zero)
      end if
C
C     Stick: within the critical elastic slip. Slip: back to it, along
C     the trial direction.
      slips = gtn .gt. gc
      hold = gc
      if (slips) hold = gtn
      w(1) = gt(1)/hold
      w(2) = gt(2)/hold
      gain = flim/hold
      s1(5) = gt(1)
      s1(6) = gt(2)
      if (slips) then
        s1(5) = gc*w(1)
        s1(6) = gc*w(2)
      end if
C     Without history the stress of the start stands for an elastic
C     slip of TAU*gc/limit: the larger the limit, the shorter. What
C     that takes off along TAU counts in stick alone.
      wl(1) = w(1)
      wl(2) = w(2)
      if (.not. keeps) then
        ge(1) = ge(1)*loss/hold
        ge(2) = ge(2)*loss/hold
        along = zero
        if (slips) along = w(1)*ge(1) + w(2)*ge(2)
        wl(1) = w(1) - ge(1) + along*w(1)
        wl(2) = w(2) - ge(2) + along*w(2)
      end if
      do i = 1, nfdir
        tau(i) = flim*w(i)
        if (slips) dslip(i) = ds*w(i)
        ddtddp(i) = flimp*wl(i)
        ddtddt(i,1) = 0.5D0*flimt*wl(i)
        ddtddt(i,2) = ddtddt(i,1)
        do j = 1, nfdir
          unit = zero
          if (i .eq. j) unit = 1.0D0
          if (slips) unit = unit - w(i)*w(j)
          ddtddg(i,j) = gain*unit + wl(i)*flimv*vrate*e(j)
          if (slips) ddtddg(i,j) = ddtddg(i,j) + w(i)*flims*w(j)
@if directs
          ddtddg(i,j) = ddtddg(i,j) + wl(i)*flimd*turn(j)
@end
        end do
        sed = sed + 0.5D0*tau(i)*s1(4+i)
      end do
      sfd = flim*ds
C
      if (keeps) then
        s1(1) = s0(1) + ds
        s1(2) = s0(2) + sfd
        s1(3) = max(s0(3), p)
        s1(4) = s0(4)
@if has_ends
        if (ftout(x)) s1(4) = s1(4) + 1.0D0
@end
        s1(7) = amu
@if has_histories
        call ftnext(s0(8), p, speed, @{temperature_now}, s1(3), gain*gtn,
     &    ds, dtime, s1(8))
@end
        call ftkeep(statev, kstep, kinc, s0, s1)
      end if
      return
      end
C
C     Length of a vector in the contact plane
      double precision function ftsize(a)
      implicit none
      double precision a(2)
      ftsize = sqrt(a(1)*a(1) + a(2)*a(2))
      return
      end
C
@{states_text}
C
@{histories_text}
@{direction_text}
@{core}
