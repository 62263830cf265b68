C     All that is computed is double precision, whatever the solver's
C     precision. A point is dealt with here, without routines of its
C     own: in a shared library a call takes as long as the interpolation
C     along an axis.
      double precision x(@{n_x}), pnorm, area, stick, move, fprev
      double precision against, dtime, fric, comp, press, speed, limit
      double precision past, trial, before, slip, work, beyond, stress
      double precision ratio, part, both, lost, fttau
      logical ftnan
      integer(8) bits, most, nofin
      external fttau, ftnan
C     The bits of infinity; above them lies NaN.
      parameter (nofin = 9218868437227405312_8)
@if reads_states
      double precision hist(@{n_hist})
@end
@include fortran/range_checks.f
@if unknown
      double precision ftqnan
      external ftqnan
@end
@if has_histories
      double precision pmax, from(@{n_histories}), next(@{n_histories})
      integer grows(@{n_histories})
      data grows /@{grows}/
@end
@if directs
      double precision way(3), axis(3), along(3), ftturn
      external ftturn
@end
C
@{reads_once}
      dtime = @{time_increment}
@if scaled
C     The process takes this many times longer than the simulation.
      if (nProps .ge. @{scale}) dtime = dtime*props(@{scale})
@end
      fTangential = 0
      do k = 1, @{points}
        pnorm = fNormal(k)
        area = @{area}
        stick = fStickForce(k)
        comp = dSlipFric(1,k)
        move = comp*comp
        comp = fTangPrev(1,k)
        fprev = comp*comp
C       The first local axis is the direction of the motion.
        against = -comp
        do i = 2, nDir
          comp = dSlipFric(i,k)
          move = move + comp*comp
          comp = fTangPrev(i,k)
          fprev = fprev + comp*comp
        end do
        move = sqrt(move)
        fprev = sqrt(fprev)
@{reads}
@if reads_states
C       The state variables, as the mean of the columns, with what is
C       rounded off them; 0 where there are none.
@end
@for kept in read
        hist(@{kept.number}) = 0.0D0
        if (@{states} .ge. @{kept.number}) then
          do j = 1, @{columns}
            part = @{state}@{kept.number}@{of_point}
            hist(@{kept.number}) = hist(@{kept.number}) + part
@if kept.is_sum
            if (@{states} .ge. @{kept.rest}) then
              part = @{state}@{kept.rest}@{of_point}
              hist(@{kept.number}) = hist(@{kept.number}) + part
            end if
@end
          end do
@if several_columns
          if (@{columns} .gt. 1)
     &      hist(@{kept.number}) = hist(@{kept.number})/@{columns}
@end
        end if
@end
@if has_histories
        do i = 1, @{n_histories}
          hist(3+i) = 0.0D0
          if (@{states} .ge. @{n_kept}) then
            do j = 1, @{columns}
              part = @{state}6+i@{of_point}
              hist(3+i) = hist(3+i) + part
              part = @{state}@{before_rest}+i@{of_point}
              hist(3+i) = hist(3+i) + part
            end do
@if several_columns
            if (@{columns} .gt. 1) hist(3+i) = hist(3+i)/@{columns}
@end
          end if
        end do
@end
C
C       NaN first: nothing below compares with one. By the bits of all
C       at once, which spares most points the calls.
        fric = 0.0D0
        most = max(ibclr(transfer(pnorm, bits), 63),
     &    ibclr(transfer(area, bits), 63),
     &    ibclr(transfer(stick, bits), 63),
     &    ibclr(transfer(move, bits), 63),
     &    ibclr(transfer(dtime, bits), 63))
        if (most .gt. nofin) then
          if (ftnan(dtime)) fric = dtime
          if (ftnan(move)) fric = move
          if (ftnan(stick)) fric = stick
          if (ftnan(area)) fric = area
          if (ftnan(pnorm)) fric = pnorm
        else if (pnorm .gt. 0.0D0 .and. area .gt. 0.0D0) then
          press = pnorm/area
          speed = 0.0D0
          if (dtime .gt. 0.0D0) speed = move/dtime
@if directs
C         The slip in global axes: its components are along the first
C         local axis, and across it and the normal.
          if (nDir .eq. 3) then
            do i = 1, 3
              along(i) = dircosSl(i,k)
              axis(i) = dircosN(i,k)
            end do
            do i = 1, 3
              j = 1 + mod(i, 3)
              l = 1 + mod(j, 3)
              way(i) = axis(j)*along(l) - axis(l)*along(j)
            end do
            do i = 1, 3
              way(i) = dSlipFric(1,k)*along(i) + dSlipFric(2,k)*way(i)
            end do
          end if
@end
@{reads_now}
@if has_histories
          call ftpast(hist(4), press, speed, @{temperature_now}@{area_now}, x)
@end
@if refuses
          fric = ftqnan()
          if (.not. ftstop(x)) fric = fttau(x)@{to_solver}
@else
          fric = fttau(x)@{to_solver}
@end
          if (ibclr(transfer(fric, bits), 63) .le. nofin) then
C           The stick force as far as friction can hold it, with its
C           sign: under penalty contact a stuck point that moves back
C           has a force along its motion, and would creep without it.
            limit = max(fric*area, 0.0D0)
            fric = max(-limit, min(limit, stick))
            past = abs(stick - fric)
C           A force before that is NaN is no reason to have none now:
C           it counts as this one.
            before = abs(fric)
            trial = past
            if (ibclr(transfer(fprev, bits), 63) .le. nofin) then
              before = fprev
              trial = abs(stick - against)
            end if
C           The stick force grows with the motion from the force before
C           it to what it is now; friction stops it at fric. What is
C           left of the motion is slip, all of a point that slides on.
C           What a falling limit releases of the elastic part is not
C           counted.
            slip = move
            if (past .lt. trial) slip = move*(past/trial)
            if (past .le. 0.0D0) slip = 0.0D0
            if (slip .lt. move .and. dtime .gt. 0.0D0)
     &        speed = slip/dtime
C           The increment that has just been done: mean of the force
C           then and the force now, times its slip.
            work = 0.0D0
            if (slip .gt. 0.0D0)
     &        work = 0.5D0*(before + abs(fric))/area*slip
            stress = abs(fric)/area
            ratio = stress/max(press, @{least})
            beyond = 0.0D0
@if has_ends
            if (ftout(x)) beyond = 1.0D0
@end
@if has_histories
            pmax = hist(3)
            if (.not. ftnan(pmax)) pmax = max(pmax, press)
C           Of sums what they gain, of all others the value itself
            do i = 1, @{n_histories}
              from(i) = hist(3+i)
            end do
            from(@{sums...}) = 0.0D0
            call ftnext(from, press, speed, @{temperature_now}@{area_now}, pmax,
     &        stress, slip, dtime, next)
@end
C           Slip and work, with what the solver's precision rounds off
C           them in 5 and 6: increments are small against their sum.
            do j = 1, @{columns}
@for sum in kept
              if (@{states} .ge. @{sum.number}) then
                both = @{state}@{sum.number}@{of_point}
                part = 0.0D0
                if (@{states} .ge. @{sum.rest})
     &            part = @{state}@{sum.rest}@{of_point}
                both = both + part + @{sum.gain}
                @{state}@{sum.number}@{of_point}
     &            = real(both, kind(@{kind}))
                if (@{states} .ge. @{sum.rest}) then
                  part = real(both, kind(@{kind}))
                  lost = 0.0D0
                  if (ibclr(transfer(part, bits), 63) .lt. nofin)
     &              lost = both - part
                  @{state}@{sum.rest}@{of_point}
     &              = real(lost, kind(@{kind}))
                end if
              end if
@end
              if (@{states} .ge. 3) then
                part = @{state}3@{of_point}
                if (ibclr(transfer(part, bits), 63) .le. nofin) then
                  if (press .gt. part) @{state}3@{of_point}
     &              = real(press, kind(@{kind}))
                end if
              end if
              if (@{states} .ge. 4) then
                part = @{state}4@{of_point}
                @{state}4@{of_point}
     &            = real(part + beyond, kind(@{kind}))
              end if
@if has_histories
              do i = 1, @{n_histories}
                if (@{states} .lt. @{n_kept}) exit
                both = 0.0D0
                if (grows(i) .eq. 1) then
                  both = @{state}6+i@{of_point}
                  part = @{state}@{before_rest}+i@{of_point}
                  both = both + part
                end if
                both = both + next(i)
                part = real(both, kind(@{kind}))
                @{state}6+i@{of_point}
     &            = real(both, kind(@{kind}))
                lost = 0.0D0
                if (ibclr(transfer(part, bits), 63) .lt. nofin)
     &            lost = both - part
                @{state}@{before_rest}+i@{of_point}
     &            = real(lost, kind(@{kind}))
              end do
@end
              if (@{states} .ge. @{at_mu}) then
                @{state}@{at_stress}@{of_point}
     &            = real(stress, kind(@{kind}))
                @{state}@{at_mu}@{of_point}
     &            = real(ratio, kind(@{kind}))
              end if
            end do
@if shown
            do i = 1, @{nodes}
              call fvkeep(@{node}, @{step}, @{increment},
     &          stress, ratio, beyond)
            end do
@end
          end if
        end if
        if (nFricDir .ge. 1)
     &    fTangential(1,k) = real(-fric, kind(fTangential))
      end do
      return
      end
C
@{histories_text}
@{direction_text}
