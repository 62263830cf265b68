C     History of a contact point that no iteration and no cutback can
C     spoil. st(1..@{n_states}): the values now, st(@{stamp}): the increment they
C     belong to, st(@{first}..@{depvar}): the values at its start. ftbegn gives
C     the start: what is kept there where st belongs to this very
C     increment, else the values now, which the last one left. So it
C     does not matter whether the solver passes the start of the
C     increment or the last iteration.
      subroutine ftbegn(st, kstep, kinc, s0)
      implicit none
      double precision st(@{depvar}), s0(@{n_states}), ftstmp
      integer kstep, kinc, i, from
      logical ftnan
      from = 0
      if (.not. ftnan(st(@{stamp}))) then
        if (abs(st(@{stamp}) - ftstmp(kstep, kinc)) .lt. 0.5D0)
     &    from = @{stamp}
      end if
      do i = 1, @{n_states}
        s0(i) = st(from+i)
      end do
      return
      end
C
      subroutine ftkeep(st, kstep, kinc, s0, s1)
      implicit none
      double precision st(@{depvar}), s0(@{n_states}), s1(@{n_states}), ftstmp
      integer kstep, kinc, i
      do i = 1, @{n_states}
        st(i) = s1(i)
        st(@{stamp}+i) = s0(i)
      end do
      st(@{stamp}) = ftstmp(kstep, kinc)
      return
      end
C
C     Step and increment as one number; 0 stands for none.
      double precision function ftstmp(kstep, kinc)
      implicit none
      integer kstep, kinc
      ftstmp = dble(kstep)*1.0D8 + dble(kinc)
      return
      end
C
