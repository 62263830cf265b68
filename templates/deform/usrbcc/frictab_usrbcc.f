C     USRBCC for DEFORM-2D (friction by user routine, FRCFAC):
C     @{result_name}, @{from}.
@{head}
C     NaN in gives NaN out.
C
C     @{result...}
C     It acts for friction only (IMODE=1 deformation, ITYPE=2), for
C     every MODEL; otherwise VARIABLE stays as it is.
C     SLDVEL and PRESS are computed for ELASTIC (meshed) dies only:
C     with rigid dies both are not what the law needs.
@if histories
C     USRNOD(1..3) of a node: accumulated slip (@{length}), friction
C     work per area (@{stress}*@{length}), peak pressure (@{stress}),
C     @{further...},
C     kept by FTUPD (frictab_usrupd.f), which USRUPD has to call once
C     per converged step: the law sees them one step late. With fewer
C     than @{n_states} user variables per node they count as 0.
@end
C     What DEFORM does not give is a constant, COMMON /FTCONS/ CST,
C     filled in BLOCK DATA FTDATA below. Nothing is read from files
C     or from USRDEF.
C     @{source...}
C
@{arguments}
C
      double precision tmpenv, tmpslf, sldvel, press
      common /ufhcom/ tmpenv, tmpslf, sldvel, press
      double precision strch, efsts, efeps
      common /ufhcom2/ strch, efsts, efeps
C
      double precision x(@{n_x}), p, flow, speed
      double precision ftcoef
      external ftcoef
@{common}
@if histories
      logical kept
@end
@if refuses
      logical ftnan, ftstop
      double precision ftqnan
      external ftnan, ftstop, ftqnan
@end
@if has_histories
      double precision h(@{n_histories}), h2(@{n_histories})
      integer i
@if has_warmest
      double precision ftmost
      external ftmost
@end
@if has_started
      double precision ftfrst
      external ftfrst
@end
@end
C
      if (imode .ne. 1) return
      if (itype .ne. 2) return
C     Magnitudes: the signs of PRESS and SLDVEL are not relied upon.
      p = abs(press)@{stress_convert}
      flow = efsts@{stress_convert}
      speed = abs(sldvel)
@if histories
      kept = nusrn .ge. @{n_states}
@end
@{reads}
@if has_histories
      do i = 1, @{n_histories}
        h(i) = 0.0D0
        h2(i) = 0.0D0
        if (kept) then
          h(i) = usrnod(3+i,node1)
          h2(i) = usrnod(3+i,node2)
        end if
      end do
@for state in warmest
C     K; a node that was never in contact is as warm as now.
      h(@{state.text}) = ftmost(h(@{state.text}), @{temperature_now} + 273.15D0)
      h2(@{state.text}) = ftmost(h2(@{state.text}), @{temperature_now} + 273.15D0)
@end
@for state in started
C     K; a node that was never in contact starts now.
      h(@{state.text}) = ftfrst(h(@{state.text}), @{temperature_now})
      h2(@{state.text}) = ftfrst(h2(@{state.text}), @{temperature_now})
@end
      do i = 1, @{n_histories}
        h(i) = 0.5D0*(h(i) + h2(i))
      end do
      call ftpast(h, abs(press), speed, @{temperature_now}, x)
@end
@if given_flow
C     k of the law's own flow stress.
      flow = x(@{flow_index})
@end
@if refuses
C     Without pressure there is nothing to look up.
      if (.not. ftnan(p)) then
        if (p .gt. 0.0D0) then
          if (ftstop(x)) then
            variable = ftqnan()
            return
          end if
        end if
      end if
@end
      variable = ftcoef(x, p, flow)@{result_convert}
      return
      end
C
@if uses_peak
C     The larger of both; NaN where one is.
      subroutine ftpeak(peak, p)
      implicit none
      double precision peak, p
      logical ftnan
      external ftnan
      if (ftnan(peak)) return
      if (ftnan(p)) then
        peak = p
      else if (p .gt. peak) then
        peak = p
      end if
      return
      end
C
@end
@{histories_text}
@{constants}
@{coefficient}
@{core}
