C     FRIC_COEF for Abaqus/Standard (*FRICTION, USER=COEFFICIENT):
C     coefficient of friction tau_R/p @{from}.
@{head}
C     @{coefficient...}
C     Below @{smallest} MPa, and without pressure, the coefficient is that
C     at @{smallest} MPa. At most @{most}.
C     NaN in gives NaN in fCoef, with derivatives 0.
C
@include abaqus/properties.f
@if new
C     State variables (DEPVAR=@{depvar}), at the end of the increment:
C     1 friction work per area (@{stress}*@{length}), 2 peak pressure (@{stress}),
C     3 increments in which the state was outside the range,
C     4 coefficient, 5 equivalent slip (@{length}), @{stamp} the increment these
C     belong to, @{first} to @{depvar} numbers 1 to @{n_states} at its start. With fewer, or
C     more than one point in a call, there is no history: friction
C     work is 0 and the peak pressure is the pressure.
C     @{histories...}
@else
C     No state variables: this argument list has none.
@end
C     @{source...}
C
@{arguments}
C
C     Canonical units (MPa, mm, mm/s) in x, y, dy, peval.
      double precision x(@{n_x}), dy(@{n_x}), y, peval, p, rate
      double precision amu, dmup, dmuv, dmus, dmut, dpeak, zero
@if new
      double precision s0(@{n_states}), s1(@{n_states}), s
      logical keeps
@end
      logical ftnan
      external ftnan
@if uses_unknown
      double precision ftqnan
      external ftqnan
@end
@if has_ends
@if new
      logical ftout
      external ftout
@end
@end
@if refuses
      logical ftstop
      external ftstop
@end
@if has_histories
C     What histories add to the derivatives by speed and temperature
      double precision hv, ht, dtime
      parameter (i_rfc_DTimCur = 3)
@end
@if directs
C     Components of the slip rate, its square, the derivatives by the
C     angle and, per radian, by the components
      double precision rate1, rate2, square, dmud, ftfold, degree
      external ftfold
      parameter (i_ifc_nFDir = 6, i_SD_SlipRate1 = 2,
     * i_SD_SlipRate2 = 3, i_fDer_SlipRate1 = 4, i_fDer_SlipRate2 = 5)
      parameter (degree = 57.29577951308232D0)
@end
      parameter (zero = 0.0D0)
C
@{reads_once}
@if new
C     The state variables lie in rData; they are those of one point.
      do i = 1, @{n_states}
        s0(i) = zero
      end do
      keeps = nBlock .eq. 1 .and. iData(i_ifc_nStateV) .ge. @{depvar}
      if (keeps) call ftbegn(rData(i_rfc_StateV),
     & iData(i_ifc_KStep), iData(i_ifc_KInc), s0)
@end
      do k = 1, nBlock
        p = pressure(k)
@if new
        rate = slipData(k,i_SD_SlipRateMag)
        s = slipData(k,i_SD_SlipEq)
@if directs
        rate1 = zero
        rate2 = zero
        if (iData(i_ifc_nFDir) .ge. 2) then
          rate1 = slipData(k,i_SD_SlipRate1)
          rate2 = slipData(k,i_SD_SlipRate2)
        end if
@end
        do j = 1, 20
          fCoefDeriv(k,j,1) = zero
        end do
@else
        rate = slipRate(k)
        do j = 1, 3
          fCoefDeriv(k,j) = zero
        end do
@end
C
C       NaN first: nothing below compares with one. What is larger
C       than 1D30 is as good as infinite.
        y = zero
        peval = @{pmin}
        if (ftnan(p)) y = p
        if (ftnan(rate)) y = rate
@if directs
        if (ftnan(rate1)) y = rate1
        if (ftnan(rate2)) y = rate2
@end
@if has_histories
        dtime = rData(i_rfc_DTimCur)
        if (ftnan(dtime)) y = dtime
@end
@if new
        if (ftnan(s)) y = s
        do i = 1, @{n_states}
          if (ftnan(s0(i))) y = s0(i)
        end do
@end
        if (.not. ftnan(y)) then
          p = min(p, 1.0D30)
          rate = min(abs(rate), 1.0D30)
@if new
          s = min(s, 1.0D30)
@end
          peval = max(p@{to_mpa}, peval)
@{reads}
@if has_histories
          do i = 1, @{n_x}
            dy(i) = zero
          end do
          call ftpast(s0(6), p, rate, @{temperature_now}, x)
@end
@if refuses
          if (p .gt. zero) then
            if (ftstop(x)) then
              y = ftqnan()
            else
              call ftgrad(x, y, dy)
            end if
          else
C           A point that does not press cannot stop the analysis.
            call ftgrad(x, y, dy)
            do i = 1, @{n_x}
              dy(i) = zero
            end do
          end if
@else
          call ftgrad(x, y, dy)
@end
        end if
        dmuv = zero
        dmup = zero
        dmut = zero
        dmus = zero
        dpeak = zero
@if directs
        dmud = zero
@end
        amu = y
        if (.not. ftnan(y)) then
          amu = y/peval
@{slopes}
@if has_histories
          hv = zero
          ht = zero
          call ftlive(s0(6), p, rate, @{temperature_now}, dy, dpeak, hv, ht)
          dmuv = dmuv + hv/peval@{to_mm_s}
@if knows_temperature
          if (nTemp .gt. 0) dmut = dmut + ht/peval
@end
@end
          dmup = dmup + dpeak - amu
          if (p@{to_mpa} .lt. peval) dmup = dpeak
          dmup = dmup/peval@{to_mpa}
          if (amu .gt. @{most}) then
            amu = @{most}
            dmuv = zero
            dmup = zero
            dmut = zero
            dmus = zero
@if directs
            dmud = zero
@end
          end if
@if new
          if (keeps) then
            do i = 1, @{n_states}
              s1(i) = s0(i)
            end do
            s1(4) = amu
            s1(5) = s
            if (p .gt. zero) then
              s1(2) = max(s0(2), p)
@if has_ends
              if (ftout(x)) s1(3) = s0(3) + 1.0D0
@end
            end if
@if frozen
C           The coefficient that the last increment left
            if (s0(4) .gt. zero) then
              amu = s0(4)
              dmuv = zero
              dmup = zero
              dmut = zero
              dmus = zero
@if directs
              dmud = zero
@end
            end if
@end
            if (p .gt. zero)
     &        s1(1) = s0(1) + amu*p*max(s - s0(5), zero)
@if has_histories
            if (p .gt. zero) call ftnext(s0(6), p, rate, @{temperature_now},
     &        s1(2), amu*p, max(s - s0(5), zero), dtime, s1(6))
@end
            call ftkeep(rData(i_rfc_StateV), iData(i_ifc_KStep),
     &        iData(i_ifc_KInc), s0, s1)
          end if
@end
        end if
@if new
        fCoef(k,1) = amu
        fCoefDeriv(k,i_fDer_SlipRateMag,1) = dmuv
        fCoefDeriv(k,i_fDer_Pressure,1) = dmup
        fCoefDeriv(k,i_fDer_Temperature,1) = dmut
        fCoefDeriv(k,i_fDer_SlipEq,1) = dmus
@if directs
C       The angle turns with what of the slip rate is across it.
        square = zero
        if (.not. ftnan(y)) square = rate1*rate1 + rate2*rate2
        if (square .gt. zero) then
          fCoefDeriv(k,i_fDer_SlipRate1,1) = -dmud*degree*rate2/square
          fCoefDeriv(k,i_fDer_SlipRate2,1) = dmud*degree*rate1/square
        end if
@end
@else
        fCoef(k) = amu
        fCoefDeriv(k,1) = dmuv
        fCoefDeriv(k,2) = dmup
        fCoefDeriv(k,3) = dmut
@end
      end do
      return
      end
C
@if new
@{states_text}
@if has_histories
C
@{histories_text}
@end
@{direction_text}
@end
@{core}
