      subroutine vfriction (
C Write only -
     *   fTangential,
C Read/Write -
     *   state,
C Read only -
     *   nBlock, nBlockAnal, nBlockEdge,
     *   nNodState, nNodSlv, nNodMst,
     *   nFricDir, nDir,
     *   nStates, nProps, nTemp, nFields,
     *   jFlags, rData,
     *   surfInt, surfSlv, surfMst,
     *   jConSlvUid, jConMstUid, props,
     *   dSlipFric, fStickForce, fTangPrev, fNormal,
     *   areaCont, dircosN, dircosSl,
     *   shapeSlv, shapeMst,
     *   coordSlv, coordMst,
     *   velSlv, velMst,
     *   tempSlv, tempMst,
     *   fieldSlv, fieldMst )
C
      include 'vaba_param.inc'
C
      dimension fTangential(nFricDir,nBlock),
     *   state(nStates,nNodState,nBlock),
     *   jConSlvUid(nNodSlv,nBlock),
     *   jConMstUid(nNodMst,nBlockAnal),
     *   props(nProps),
     *   dSlipFric(nDir,nBlock),
     *   fStickForce(nBlock),
     *   fTangPrev(nDir,nBlock),
     *   fNormal(nBlock),
     *   areaCont(nBlock),
     *   dircosN(nDir,nBlock),
     *   dircosSl(nDir,nBlock),
     *   shapeSlv(nNodSlv,nBlockEdge),
     *   shapeMst(nNodMst,nBlockAnal)
      dimension coordSlv(nDir,nNodSlv,nBlock),
     *   coordMst(nDir,nNodMst,nBlockAnal),
     *   velSlv(nDir,nNodSlv,nBlock),
     *   velMst(nDir,nNodMst,nBlockAnal),
     *   tempSlv(nBlock),
     *   tempMst(nBlockAnal),
     *   fieldSlv(nFields,nBlock),
     *   fieldMst(nFields,nBlockAnal)
C     nBlockAnal is nBlock, or 1 with an analytical rigid surface.
C     rData: step time, total time, time increment, friction work.
      dimension jFlags(3), rData(4)
      character*80 surfInt, surfSlv, surfMst
