C     One contact point, in double precision. In: x as far as the entry
C     fills it; normal force, area, stick force, slip of the increment
C     and its time, size of the friction force before it; hist: slip,
C     work per area and peak pressure before it. Out: fric, against the
C     slip; add: what the state variables gain, where lkeep.
@if has_histories
C     From hist(4) and add(5) on: further histories, see ftpast; of what
C     is no sum add is the value itself.
@end
      subroutine ftpnt(x, pnorm, area, stick, slip, dtime, fprev, hist,
     &  fric, add, lkeep)
      implicit none
      double precision x(@{n_x}), pnorm, area, stick, slip, dtime, fprev
      double precision hist(@{n_hist}), fric, add(@{n_add}), press, speed, fttau
      logical lkeep, ftnan
      integer i
      integer*8 bits, most
      external fttau, ftnan
@if has_axes
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
     &  ibclr(transfer(slip, bits), 63),
     &  ibclr(transfer(dtime, bits), 63))
      if (most .gt. 9218868437227405312_8) then
        if (ftnan(dtime)) fric = dtime
        if (ftnan(slip)) fric = slip
        if (ftnan(stick)) fric = stick
        if (ftnan(area)) fric = area
        if (ftnan(pnorm)) fric = pnorm
      else if (pnorm .gt. 0.0D0 .and. area .gt. 0.0D0) then
        press = pnorm/area
        speed = 0.0D0
        if (dtime .gt. 0.0D0) speed = slip/dtime
@{reads}
@if has_histories
        call ftpast(hist(4), press, speed, @{temperature_now}, x)
@end
@if refuses
        fric = ftqnan()
        if (.not. ftstop(x)) fric = fttau(x)@{to_solver}
@else
        fric = fttau(x)@{to_solver}
@end
        if (ftnan(fric)) return
        fric = fric*area
        if (fric .gt. stick) fric = stick
        if (fric .lt. 0.0D0) fric = 0.0D0
        lkeep = .true.
        add(1) = slip
C       The increment that has just been done: mean of the force then
C       and the force now, times its slip.
        if (slip .gt. 0.0D0) add(2) = 0.5D0*(fprev + fric)/area*slip
        add(3) = press
@if has_axes
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
        call ftnext(from, press, speed, @{temperature_now}, pmax, fric/area,
     &    slip, dtime, add(5))
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
        if (nst .ge. @{n_states}) then
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
      integer*8 bits, nofin
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
          if (nst .lt. @{n_states}) exit
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
      end do
      return
      end
C
@if has_histories
@{histories_text}
@end
