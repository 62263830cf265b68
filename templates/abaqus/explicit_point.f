C     One contact point, in double precision. In: x as far as the entry
C     fills it; normal force, area, stick force, relative motion of the
C     increment and its time, the friction force before it: its size and
C     what of it acts against the motion; hist: slip, work per area and
C     peak pressure before it. Out: fric, against the motion; add: what
C     the state variables gain, where lkeep.
C     The force is the stick force as far as friction can hold it, with
C     its sign: under penalty contact a stuck point that moves back has
C     a force along its motion, and would creep without it.
@if has_histories
C     From hist(4) and add(5) on: further histories, see ftpast; of what
C     is no sum add is the value itself.
@end
      subroutine ftpnt(x, pnorm, area, stick, move, dtime, fprev,
     &  against, hist, fric, add, lkeep)
      implicit none
      double precision x(@{n_x}), pnorm, area, stick, move, dtime, fprev
      double precision against, hist(@{n_hist}), fric, add(@{n_add}), press
      double precision speed, limit, past, trial, before, slip, fttau
      logical lkeep, ftnan
      integer i
      integer(8) bits, most
      external fttau, ftnan
@if has_ends
      logical ftout
      external ftout
@end
@if refuses
      double precision ftqnan
      logical ftstop
      external ftqnan, ftstop
@end
@if has_histories
      double precision pmax, from(@{n_histories})
@end
      lkeep = .false.
      do i = 1, @{n_add}
        add(i) = 0.0D0
      end do
C     NaN first: nothing below compares with one. By the bits of all
C     at once, which spares most points the calls.
      fric = 0.0D0
      most = max(ibclr(transfer(pnorm, bits), 63),
     &  ibclr(transfer(area, bits), 63),
     &  ibclr(transfer(stick, bits), 63),
     &  ibclr(transfer(move, bits), 63),
     &  ibclr(transfer(dtime, bits), 63))
      if (most .gt. 9218868437227405312_8) then
        if (ftnan(dtime)) fric = dtime
        if (ftnan(move)) fric = move
        if (ftnan(stick)) fric = stick
        if (ftnan(area)) fric = area
        if (ftnan(pnorm)) fric = pnorm
      else if (pnorm .gt. 0.0D0 .and. area .gt. 0.0D0) then
        press = pnorm/area
        speed = 0.0D0
        if (dtime .gt. 0.0D0) speed = move/dtime
@{reads}
@if has_histories
        call ftpast(hist(4), press, speed, @{temperature_now}@{area_now}, x)
@end
@if refuses
        fric = ftqnan()
        if (.not. ftstop(x)) fric = fttau(x)@{to_solver}
@else
        fric = fttau(x)@{to_solver}
@end
        if (ftnan(fric)) return
        limit = max(fric*area, 0.0D0)
        fric = max(-limit, min(limit, stick))
        past = abs(stick - fric)
        lkeep = .true.
C       A force before that is NaN is no reason to have none now: it
C       counts as this one.
        before = abs(fric)
        trial = past
        if (.not. ftnan(fprev)) then
          before = fprev
          trial = abs(stick - against)
        end if
C       The stick force grows with the motion from the force before it
C       to what it is now; friction stops it at fric. What is left of
C       the motion is slip, all of a point that slides on. What a
C       falling limit releases of the elastic part is not counted.
        slip = move
        if (past .lt. trial) slip = move*(past/trial)
        if (past .le. 0.0D0) slip = 0.0D0
        if (slip .lt. move .and. dtime .gt. 0.0D0) speed = slip/dtime
        add(1) = slip
C       The increment that has just been done: mean of the force then
C       and the force now, times its slip.
        if (slip .gt. 0.0D0)
     &    add(2) = 0.5D0*(before + abs(fric))/area*slip
        add(3) = press
        add(@{add_stress}) = abs(fric)/area
        add(@{add_mu}) = add(@{add_stress})/max(press, @{least})
@if has_ends
        if (ftout(x)) add(4) = 1.0D0
@end
@if has_histories
        pmax = hist(3)
        if (.not. ftnan(pmax)) pmax = max(pmax, press)
        do i = 1, @{n_histories}
          from(i) = hist(3+i)
        end do
@for sum in sums
        from(@{sum.number}) = 0.0D0
@end
        call ftnext(from, press, speed, @{temperature_now}@{area_now}, pmax,
     &    abs(fric)/area, slip, dtime, add(5))
@end
      end if
      return
      end
C
C     What the state variables of a point hold, as the mean of its
C     columns: slip, work, peak pressure; 0 where there are none.
      subroutine ftread(nst, ncol, st, hist)
      include 'vaba_param.inc'
      dimension st(nst,ncol)
      double precision hist(@{n_hist}), part
      do i = 1, 3
        hist(i) = 0.0D0
        if (nst .ge. i) then
          do j = 1, ncol
            part = st(i,j)
            hist(i) = hist(i) + part
            if (i .le. 2 .and. nst .ge. i + 4) then
              part = st(i+4,j)
              hist(i) = hist(i) + part
            end if
          end do
          if (ncol .gt. 1) hist(i) = hist(i)/ncol
        end if
      end do
@if has_histories
C     Further histories and what is rounded off them, as one.
      do i = 1, @{n_histories}
        hist(3+i) = 0.0D0
        if (nst .ge. @{n_kept}) then
          do j = 1, ncol
            part = st(6+i,j)
            hist(3+i) = hist(3+i) + part
            part = st(@{before_rest}+i,j)
            hist(3+i) = hist(3+i) + part
          end do
          if (ncol .gt. 1) hist(3+i) = hist(3+i)/ncol
        end if
      end do
@end
      return
      end
C
C     Adds an increment to each column. What the solver's precision
C     rounds off slip and work is kept in 5 and 6: increments are small
C     against their sum.
      subroutine ftkeep(nst, ncol, st, add)
      include 'vaba_param.inc'
      dimension st(nst,ncol)
      double precision add(@{n_add}), both, part, lost
      integer(8) bits, nofin
@if has_histories
      integer grows(@{n_histories})
      data grows /@{grows}/
@end
C     The bits of infinity; above them lies NaN.
      parameter (nofin = 9218868437227405312_8)
      do j = 1, ncol
        do i = 1, min(2,nst)
          both = st(i,j)
          part = 0.0D0
          if (nst .ge. i + 4) part = st(i+4,j)
          both = both + part + add(i)
          st(i,j) = real(both, kind(st))
          if (nst .ge. i + 4) then
            part = st(i,j)
            lost = 0.0D0
            if (ibclr(transfer(part, bits), 63) .lt. nofin)
     &        lost = both - part
            st(i+4,j) = real(lost, kind(st))
          end if
        end do
        if (nst .ge. 3) then
          part = st(3,j)
          if (ibclr(transfer(part, bits), 63) .le. nofin) then
            if (add(3) .gt. part) st(3,j) = real(add(3), kind(st))
          end if
        end if
        if (nst .ge. 4) then
          part = st(4,j)
          st(4,j) = real(part + add(4), kind(st))
        end if
@if has_histories
        do i = 1, @{n_histories}
          if (nst .lt. @{n_kept}) exit
          both = 0.0D0
          if (grows(i) .eq. 1) then
            both = st(6+i,j)
            part = st(@{before_rest}+i,j)
            both = both + part
          end if
          both = both + add(4+i)
          st(6+i,j) = real(both, kind(st))
          part = st(6+i,j)
          lost = 0.0D0
          if (ibclr(transfer(part, bits), 63) .lt. nofin)
     &      lost = both - part
          st(@{before_rest}+i,j) = real(lost, kind(st))
        end do
@end
        if (nst .ge. @{at_mu}) then
          st(@{at_stress},j) = real(add(@{add_stress}), kind(st))
          st(@{at_mu},j) = real(add(@{add_mu}), kind(st))
        end if
      end do
      return
      end
C
@if has_histories
@{histories_text}
@end
