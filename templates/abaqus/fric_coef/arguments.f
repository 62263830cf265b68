@if new
      subroutine fric_coef (
C Write only -
     * fCoef, fCoefDeriv,
C Read only, except state variables within rData -
     * nBlock, nProps, nTemp, nFields,
     * iData, rData,
     * surfInt, surfSec, surfMain,
     * props, slipData, pressure,
     * tempAvg, fieldAvg)
@else
      subroutine fric_coef (
C Write only -
     * fCoef, fCoefDeriv,
C Read only -
     * nBlock, nProps, nTemp, nFields,
     * jFlags, rData,
     * surfInt, surfSlv, surfMst,
     * props, slipRate, pressure,
     * tempAvg, fieldAvg)
@end
C
      include 'aba_param.inc'
C
@if new
      dimension fCoef(nBlock,2), fCoefDeriv(nBlock,20,2),
     * props(nProps), slipData(nBlock,6), pressure(nBlock),
     * tempAvg(nBlock), fieldAvg(nBlock,nFields)
      parameter (i_ifc_KStep = 1, i_ifc_KInc = 2, i_ifc_nStateV = 5,
     * nDataI = 6, i_rfc_StateV = 8, i_SD_SlipRateMag = 1,
     * i_SD_SlipEq = 4, i_fDer_SlipRateMag = 1,
     * i_fDer_Pressure = 2, i_fDer_Temperature = 3,
     * i_fDer_SlipEq = 6)
      dimension iData(nDataI), rData(*)
      character*80 surfInt, surfSec, surfMain
@else
      dimension fCoef(nBlock), fCoefDeriv(nBlock,3),
     * props(nProps), slipRate(nBlock), pressure(nBlock),
     * tempAvg(nBlock), fieldAvg(nBlock,nFields)
      dimension jFlags(2), rData(3)
      character*80 surfInt, surfSlv, surfMst
@end
