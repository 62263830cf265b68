      subroutine vfric_coef (
C Write only -
     *   fCoef, fCoefDeriv,
C Read only -
     *   nBlock, nProps, nTemp, nFields,
     *   jFlags, rData,
     *   surfInt, surfSlv, surfMst,
     *   props, slipRate, pressure,
     *   tempAvg, fieldAvg )
C
      include 'vaba_param.inc'
C
      dimension fCoef(nBlock), fCoefDeriv(nBlock,3), props(nProps),
     *   slipRate(nBlock), pressure(nBlock), tempAvg(nBlock),
     *   fieldAvg(nBlock,nFields)
      dimension jFlags(2), rData(3)
      character*80 surfInt, surfSlv, surfMst
