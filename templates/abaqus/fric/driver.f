C     Calls FRIC as Abaqus/Standard does: each point in the first
C     increment of a contact that already slips (see ftdriv in
C     src/codegen/driver.h). States: 1 pressure, 2 speed, 3 slip,
C     4 work, 5 peak pressure, 6 temperature, 7 direction of slip.
      subroutine ftdriv(n, ns, v, np, prop, nf, field, nh, hist, tau)
      include 'aba_param.inc'
@include fortran/ftdriv_arguments.f
C     Powers of two: dividing by them changes no bits. Any motion is
C     more than the critical slip.
      parameter (dtime = 2.0D0**(-30), slipcr = 2.0D0**(-50))
      character*80 cin, csl, cms
      dimension t(2), ddg(2,2), ddp(2), ds(2), ddt(2,2), dg(2), tlm(2)
      dimension tot(2), time(2), co(3), rco(3), drot(2,2), temp(2)
      dimension st(15+2*nh), pre(2,nf), props(np+1), along(2)
      save npoint
      data npoint /0/
      cin = '@{contact}'
      csl = 'SEC'
      cms = 'MAIN'
      nst = 15 + 2*nh
      nprops = np + 1
      npred = nf
      do i = 1, np
        props(i) = prop(i)
      end do
      props(nprops) = slipcr
      time = 0
      co = 0
      rco = 0
      tlm = 0
      tot = 0
      drot = 0
      drot(1,1) = 1
      drot(2,2) = 1
      do k = 1, n
C       Every other point slips in two directions.
        npoint = npoint + 1
        nfdir = 1 + mod(npoint, 2)
        along = 0
        along(1) = 1
        if (nfdir .eq. 2) along(1) = 0.6D0
        if (nfdir .eq. 2) along(2) = 0.8D0
@if directs
        nfdir = 2
        along(1) = cos(v(7,k)/57.29577951308232D0)
        along(2) = sin(v(7,k)/57.29577951308232D0)
        if (abs(along(1)) .lt. 1.0D-15) along(1) = 0
        if (abs(along(2)) .lt. 1.0D-15) along(2) = 0
@end
        ddg = 0
        ddp = 0
        ds = 0
        ddt = 0
        t = 0
        temp = v(6,k)
        pre(1,:) = field(:,k)
        pre(2,:) = field(:,k)
C       The slip that was there before this increment, in the same
C       direction
        dg = along*(v(2,k)*dtime)
        st = 0
        st(1) = v(3,k) - v(2,k)*dtime
        st(2) = v(4,k)
        st(3) = v(5,k)
        st(5) = along(1)*slipcr
        st(6) = along(2)*slipcr
        do i = 1, nh
          st(7+i) = hist(i,k)
        end do
        lm = 0
        pnewdt = 1
        call fric(lm, t, ddg, ddp, ds, sed, sfd, ddt, pnewdt, st, dg,
     &    tlm, v(1,k), 0.0D0, 0.0D0, tot, 1, 1, time, dtime, 0, cin,
     &    csl, cms, 1, 7, 0, co, rco, drot, temp, pre, nfdir, nfdir+1,
     &    npred, nst, 1.0D0, props, nprops)
        tau(k) = t(1)
        if (nfdir .eq. 2) tau(k) = hypot(t(1), t(2))
      end do
      end
C
C     One call of FRIC for each point (ftincr in
C     src/codegen/driven_path.h). par: time increment, step, increment.
C     v: pressure, motion (2), stress before (2), temperatures (2),
C     LM, directions, rotation of the axes (4), CHRLNGTH.
C     out: LM, TAU (2), DDTDDG (4), DDTDDP (2), DDTDDT (4), DSLIP (2),
C     SED, SFD, PNEWDT.
      subroutine ftincr(n, npar, par, nv, v, ns, st, np, prop, nf,
     &  field, nout, out)
      include 'aba_param.inc'
@include fortran/ftincr_arguments.f
      character*80 cin, csl, cms
      dimension t(2), ddg(2,2), ddp(2), ds(2), ddt(2,2), dg(2), tlm(2)
      dimension tot(2), time(2), co(3), rco(3), drot(2,2), temp(2)
      dimension pre(2,nf), g1(1,1), d1(1,2)
      cin = '@{contact}'
      csl = 'SEC'
      cms = 'MAIN'
      time(1) = 3*par(1)
      time(2) = 5*par(1)
C     What the routine has no use for
      co = huge(co)
      rco = huge(rco)
      tlm = huge(tlm)
      tot = huge(tot)
      do k = 1, n
        lm = nint(v(8,k))
        nfdir = nint(v(9,k))
        dg = v(2:3,k)
        t = v(4:5,k)
        temp = v(6:7,k)
        drot(1,1) = v(10,k)
        drot(2,1) = v(11,k)
        drot(1,2) = v(12,k)
        drot(2,2) = v(13,k)
        pre(1,:) = field(1:nf,k)
        pre(2,:) = field(nf+1:2*nf,k)
        ddg = 77
        ddp = 77
        ds = 77
        ddt = 77
        g1 = 77
        d1 = 77
        sed = 77
        sfd = 77
        pnewdt = 0.875D0
        if (nfdir .eq. 2) then
          call fric(lm, t, ddg, ddp, ds, sed, sfd, ddt, pnewdt, st(1,k),
     &      dg, tlm, v(1,k), 0.25D0*v(1,k), 1.0D30, tot, nint(par(2)),
     &      nint(par(3)), time, par(1), 21, cin, csl, cms, 17, 7, 13,
     &      co, rco, drot, temp, pre, nfdir, 3, int(nf), int(ns),
     &      v(14,k), prop, int(np))
        else
          call fric(lm, t, g1, ddp, ds, sed, sfd, d1, pnewdt, st(1,k),
     &      dg, tlm, v(1,k), 0.25D0*v(1,k), 1.0D30, tot, nint(par(2)),
     &      nint(par(3)), time, par(1), 21, cin, csl, cms, 17, 7, 13,
     &      co, rco, drot, temp, pre, nfdir, 2, int(nf), int(ns),
     &      v(14,k), prop, int(np))
          ddg(1,1) = g1(1,1)
          ddt(1,:) = d1(1,:)
        end if
        out(1,k) = lm
        out(2:3,k) = t
        out(4:5,k) = ddg(:,1)
        out(6:7,k) = ddg(:,2)
        out(8:9,k) = ddp
        out(10:11,k) = ddt(:,1)
        out(12:13,k) = ddt(:,2)
        out(14:15,k) = ds
        out(16,k) = sed
        out(17,k) = sfd
        out(18,k) = pnewdt
      end do
      end
