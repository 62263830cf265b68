C     USRFRC for LS-DYNA (SMP): friction force of an interface by
C     tau_R, @{from}.
@{head}
C     NaN in gives a NaN force; such a node's history stays as it was.
C
C     UA, constants of the interface (a constant the deck does not
C     give takes the value in brackets):
C     @{properties...}
C     UFHIST (NHSV=@{n_history}), by node:
C     1 accumulated slip (@{length}), 2 friction work per area
C     (@{stress}*@{length}), 3 peak pressure (@{stress}), 4 cycles in
C     which the state was outside the range, 5 and 6 what the solver's
C     precision rounds off 1 and 2.
@if has_histories
C     @{histories...}
C     from @{first_rest} on: what the solver's precision rounds off them.
C     @{at_stress} frictional shear stress (@{stress}) of the last cycle in
C     contact, @{n_history} that over the pressure: to be looked at.
C     With fewer the missing ones of 1 to 3 count as 0, and of those
C     behind them integrals as 0, peaks and means as the present value.
@else
C     @{at_stress} frictional shear stress (@{stress}) of the last cycle in
C     contact, @{n_history} that over the pressure: to be looked at.
C     With fewer the missing ones count as 0.
@end
C
C     LS-DYNA leaves the friction force to this routine: the force
C     that would hold the node (old force and stiffness times relative
C     displacement, tangential part) is cut down to tau_R times the
C     node's area, times the segment's scale factor FRC(1,.). FS, FD,
C     DC and VC of the contact card have no influence.
C     @{source...}
C
C     Default real and integer are those of the solver's precision, as
C     its own Makefile sets them; all that is computed is double.
@{arguments}
@if uses_temperature
C     itopaz(1) = 999: temperatures are computed.
      integer itopaz
      common /thropt/ itopaz(101)
      double precision h1, h2, h3, h4, tseg
@end
C
      double precision x(@{n_x}), d(3), f(3), rn(3), area, pnorm, press
      double precision stiff, slip, speed, rate, proj, hold, fprev, fric
      double precision over, stress
C     Slip and work before this cycle; a sum as UFHIST holds it
      double precision kept(2), part
      double precision scale, ssum, pmax
      double precision fttau, ftqnan, ftlost
      logical ftnan
      external fttau, ftqnan, ftlost, ftnan
@include fortran/range_checks.f
@if has_histories
      double precision past(@{n_histories}), next(@{n_histories}), dtime
@end
@if directs
C     Tangential part of the relative displacement
      double precision way(3), ftturn
      external ftturn
@end
      integer i, ii, j, kk
C
@{reads_once}
      rate = fdt2
@if scaled
C     The process takes this many times longer than the simulation.
      if (ninput .ge. @{scale}) rate = rate/ua(@{scale})
@end
      do kk = 1, niisv5
        ii = iisv5(kk)
        j = ilbsv(ii)
        area = areas(ii)
C       compression is negative
        pnorm = -fni(ii)
        d(1) = dx(ii)
        d(2) = dy(ii)
        d(3) = dz(ii)
        rn(1) = rn1(ii)
        rn(2) = rn2(ii)
        rn(3) = rn3(ii)
        stiff = stfk(ii)
        stiff = stiff*sfacn3
C
C       Tangential parts of the relative displacement and of the force
C       that would hold the node; magnitude of the force before.
        proj = d(1)*rn(1) + d(2)*rn(2) + d(3)*rn(3)
        slip = 0.0D0
        fprev = 0.0D0
        do i = 1, 3
          f(i) = fdat(2+i,ii)
          fprev = fprev + f(i)*f(i)
          f(i) = f(i) + stiff*d(i)
          slip = slip + (d(i) - proj*rn(i))**2
@if directs
          way(i) = d(i) - proj*rn(i)
@end
        end do
        slip = sqrt(slip)
        fprev = sqrt(fprev)
        proj = f(1)*rn(1) + f(2)*rn(2) + f(3)*rn(3)
        hold = 0.0D0
        do i = 1, 3
          f(i) = f(i) - proj*rn(i)
          hold = hold + f(i)*f(i)
        end do
        hold = sqrt(hold)
C
C       NaN first: nothing below compares with one.
        fric = 0.0D0
        if (ftnan(pnorm)) then
          fric = pnorm
        else if (ftnan(area)) then
          fric = area
        else if (ftnan(hold)) then
          fric = hold
        else if (ftnan(slip)) then
          fric = slip
        else if (ftnan(rate)) then
          fric = rate
        else if (pnorm .gt. 0.0D0 .and. area .le. 0.0D0) then
C         A contact of another type: tau_R has nothing to act on.
          call ftarea
          fric = ftqnan()
        else if (pnorm .gt. 0.0D0) then
          press = pnorm/area
          speed = 0.0D0
          if (slip .gt. 0.0D0) speed = slip*rate
          do i = 1, 2
            kept(i) = 0.0D0
            if (nhv .ge. i) kept(i) = ufhist(i,j)
            if (nhv .ge. 4 + i) kept(i) = kept(i) + ufhist(4+i,j)
          end do
          ssum = kept(1) + slip
          pmax = press
          if (nhv .ge. 3) then
            pmax = ufhist(3,j)
            if (.not. ftnan(pmax)) pmax = max(pmax, press)
          end if
@{reads}
@if has_histories
          do i = 1, @{n_histories}
            past(i) = 0.0D0
            if (nhv .ge. @{n_kept}) then
              past(i) = ufhist(@{before_rest}+i,j)
              past(i) = past(i) + ufhist(6+i,j)
            end if
          end do
          call ftpast(past, press, speed, @{temperature_now}@{area_now}, x)
@end
@if refuses
          if (ftstop(x)) then
            fric = ftqnan()
          else
            fric = fttau(x)@{to_solver}
          end if
@else
          fric = fttau(x)@{to_solver}
@end
          if (.not. ftnan(fric)) then
            scale = frc(1,lsv(ii))
            fric = fric*area*scale
            if (.not. ftnan(fric)) then
              if (fric .gt. hold) fric = hold
              if (fric .lt. 0.0D0) fric = 0.0D0
C             What the force that would hold the node exceeds friction
C             by is slip; the rest of the motion was elastic.
              over = hold - fric
              if (over .lt. stiff*slip) slip = over/stiff
              if (over .le. 0.0D0) slip = 0.0D0
              speed = 0.0D0
              if (slip .gt. 0.0D0) speed = slip*rate
C             Work: mean of the force before and the force now.
              kept(1) = kept(1) + slip
              kept(2) = kept(2) + 0.5D0*(fprev + fric)/area*slip
              do i = 1, 2
                if (nhv .lt. i) exit
                ufhist(i,j) = real(kept(i), kind(ufhist))
                if (nhv .ge. 4 + i) then
                  part = ufhist(i,j)
                  part = ftlost(kept(i), part)
                  ufhist(4+i,j) = real(part, kind(ufhist))
                end if
              end do
              if (nhv .ge. 3) ufhist(3,j) = real(pmax, kind(ufhist))
              if (nhv .ge. @{n_history}) then
                stress = fric/area
                ufhist(@{at_stress},j) = real(stress, kind(ufhist))
                stress = stress/max(press, @{least})
                ufhist(@{n_history},j) = real(stress, kind(ufhist))
              end if
@if has_ends
              if (nhv .ge. 4) then
                if (ftout(x)) ufhist(4,j) = ufhist(4,j) + 1
              end if
@end
@if has_histories
              if (nhv .ge. @{n_kept}) then
                dtime = 0.0D0
                if (rate .gt. 0.0D0) dtime = 1.0D0/rate
                call ftnext(past, press, speed, @{temperature_now}@{area_now}, pmax,
     &            fric/area, slip, dtime, next)
                do i = 1, @{n_histories}
                  ufhist(6+i,j) = real(next(i), kind(ufhist))
                  part = ufhist(6+i,j)
                  part = ftlost(next(i), part)
                  ufhist(@{before_rest}+i,j) = real(part, kind(ufhist))
                end do
              end if
@end
            end if
          end if
        end if
C
C       The force along what would hold the node, kept for the next
C       cycle and added to the node's force.
        scale = 0.0D0
        if (ftnan(fric)) then
          scale = fric
        else if (hold .gt. 0.0D0) then
          scale = fric/hold
        end if
        do i = 1, 3
          f(i) = f(i)*scale
          if (ftnan(scale)) f(i) = scale
          fdat(2+i,ii) = real(f(i), kind(fdat))
        end do
        fxis(ii) = real(fxis(ii) + f(1), kind(fxis))
        fyis(ii) = real(fyis(ii) + f(2), kind(fyis))
        fzis(ii) = real(fzis(ii) + f(3), kind(fzis))
        iseg(ii) = lsv(ii)
        fdat(1,ii) = ss(ii)
        fdat(2,ii) = tt(ii)
      end do
      return
      end
C
C     What a sum has beyond the number that is kept of it; nothing of
C     an infinite one.
      double precision function ftlost(whole, part)
      implicit none
      double precision whole, part
      logical ftnan
      external ftnan
      ftlost = 0.0D0
      if (ftnan(part)) return
      if (abs(part) .lt. 1.0D300) ftlost = whole - part
      return
      end
C
C     A pressed node without area ends the analysis.
      subroutine ftarea
      implicit none
      call ftquit('friction table: the contact gives no nodal areas; '
     &  // 'use a forming or one-way contact')
      return
      end
C
@{histories_text}
@{direction_text}
@{core}
