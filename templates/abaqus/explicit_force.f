C     All that is computed is double precision, whatever the solver's
C     precision.
      double precision x(@{n_x}), pnorm, area, stick, move, fprev
      double precision against, dtime, fric, comp, hist(@{n_hist}), add(@{n_add})
      logical lkeep
@if unknown
      double precision ftqnan
      external ftqnan
@end
C
@{reads_once}
      dtime = @{time_increment}
@if scaled
C     The process takes this many times longer than the simulation.
      if (nProps .ge. @{scale}) dtime = dtime*props(@{scale})
@end
      do k = 1, @{points}
        do i = 1, nFricDir
          fTangential(i,k) = 0
        end do
        pnorm = fNormal(k)
        area = @{area}
        stick = fStickForce(k)
        move = 0.0D0
        fprev = 0.0D0
        do i = 1, nDir
          comp = dSlipFric(i,k)
          move = move + comp*comp
          comp = fTangPrev(i,k)
          fprev = fprev + comp*comp
        end do
        move = sqrt(move)
        fprev = sqrt(fprev)
C       The first local axis is the direction of the motion.
        against = -fTangPrev(1,k)
@{reads}
        do i = 1, @{n_hist}
          hist(i) = 0.0D0
        end do
        if (@{states} .ge. 1) call ftread(@{states}, @{columns},
     &    @{state}, hist)
        call ftpnt(x, pnorm, area, stick, move, dtime, fprev,
     &    against, hist, fric, add, lkeep)
        if (lkeep .and. @{states} .ge. 1) call ftkeep(@{states},
     &    @{columns}, @{state}, add)
@if shown
        if (lkeep) then
          do i = 1, @{nodes}
            call fvkeep(@{node}, @{step}, @{increment},
     &        add(@{add_stress}), add(@{add_mu}), add(4))
          end do
        end if
@end
        if (nFricDir .ge. 1)
     &    fTangential(1,k) = real(-fric, kind(fTangential))
      end do
      return
      end
C
