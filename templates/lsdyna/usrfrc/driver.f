C     Calls USRFRC as LS-DYNA does, for a block of contact nodes (see
C     ftdriv in src/codegen/driver.h). States: 1 pressure, 2 speed,
C     3 slip, 4 work, 5 peak pressure, 6 temperature, 7 direction of
C     slip. Default real and integer are the solver's, as the routine's.
      subroutine ftdriv(n, ns, v, np, prop, nf, field, nh, hist, tau)
      implicit none
@include fortran/ftdriv_arguments.f
C     Powers of two: dividing by them changes no bits.
      real*8 step, a
@if directs
      real*8 way(3), axis(3)
@end
      parameter (step = 2.0D0**(-30))
      integer insv(n), lsv(n), ix(n,4), iisv5(n), iseg(n), ilbsv(n)
      integer npc(1), lcfst(1), lcfdt(1), isurf(5*n,1), nhv, i, k, j
      integer nact, nin, nodes, nosl
      real areas(n), none(5*n), fni(n), d(n,3), ua(np), rn(n,3)
      real fdat(5,n), f(n,3), ss(n), tt(n), stfk(n), frc(2,n), pld(2,1)
      real temp(5*n), ufhist(8+2*nh,n), ufeps(1,1)
      character*6 side
      integer itopaz
      common /thropt/ itopaz(101)
      itopaz(1) = 999
      nhv = 8 + 2*nh
      nact = n
      nin = np
      nodes = 5*n
      do i = 1, np
        ua(i) = real(prop(i), kind(ua))
      end do
      none = 0
      npc = 0
      lcfst = 0
      lcfdt = 0
      isurf = 0
      pld = 0
      ufeps = 0
      side = 'master'
      d = 0
      rn = 0
      rn(:,3) = 1
      f = 0
      ss = 0
      tt = 0
      stfk = 0
      frc = 1
      fdat = 0
      iseg = 0
      do k = 1, n
        insv(k) = k
        lsv(k) = k
        iisv5(k) = k
C       Histories not in the nodes' order
        j = n + 1 - k
        ilbsv(k) = j
        do i = 1, 4
          ix(k,i) = i*n + k
        end do
        a = 2.0D0**(mod(k - 1, 4) - 2)
        areas(k) = real(a, kind(areas))
        fni(k) = real(-v(1,k)*a, kind(fni))
C       Across the force that was there before, and along the normal;
C       that force is large, so that sliding is what happens.
        d(k,2) = real(v(2,k)*step, kind(d))
        d(k,3) = 3
        fdat(3,k) = 2.0**60
@if directs
C       The force before is along the reference direction.
        call ftway(0.0D0, way, axis)
        fdat(3:5,k) = real(way*2.0D0**60, kind(fdat))
        call ftway(v(7,k), way, axis)
        d(k,:) = real(v(2,k)*step*way, kind(d))
        rn(k,:) = real(axis, kind(rn))
@end
        do i = 0, 4
          temp(i*n+k) = real(v(6,k), kind(temp))
        end do
C       What was slipped before this cycle
        ufhist(:,j) = 0
        ufhist(1,j) = real(v(3,k), kind(ufhist))
     &    - real(v(2,k)*step, kind(ufhist))
        ufhist(2,j) = real(v(4,k), kind(ufhist))
        ufhist(3,j) = real(v(5,k), kind(ufhist))
@if has_area
        hist(@{first_area},k) = hist(@{first_area},k)*a
@end
        do i = 1, nh
          ufhist(6+i,j) = real(hist(i,k), kind(ufhist))
          ufhist(6+nh+i,j) = real(hist(i,k) - ufhist(6+i,j),
     &      kind(ufhist))
        end do
      end do
      nosl = @{contact}
      call usrfrc(nosl, none, 1, none, insv, areas, none, none, none,
     &  lsv, ix(1,1), ix(1,2), ix(1,3), ix(1,4), none, none, none, none,
     &  none, none, fni, d(1,1), d(1,2), d(1,3), real(1/step, kind(d)),
     &  nin, ua, side, iisv5, nact, rn(1,1), rn(1,2), rn(1,3), none,
     &  none, none, none, none, fdat, iseg, f(1,1), f(1,2), f(1,3), ss,
     &  tt, ilbsv, stfk, frc, nodes, npc, pld, lcfst, lcfdt, temp, none,
     &  none, isurf, nhv, ufhist, 1, ufeps, real(1, kind(d)))
      do k = 1, n
        tau(k) = f(k,1)/2.0D0**(mod(k - 1, 4) - 2)
@if directs
        call ftway(0.0D0, way, axis)
        tau(k) = sum(f(k,:)*way)/2.0D0**(mod(k - 1, 4) - 2)
@end
      end do
      end
C
@if directs
@include fortran/direction_vectors.f
@end
C     One cycle of USRFRC (ftincr in src/codegen/driven_path.h).
C     par: 1 over the time increment, whether there are temperatures,
C     scale of the stiffness, segments, nodes. v: normal force, area,
C     motion (3), normal (3), force before (3), stiffness, scale of the
C     segment, place on it (2), temperatures of the node and of the
C     segment's (4), node, segment, place in the history. out: force
C     (3), force kept (3), what else is kept of the contact (3), changed
C     values of other places.
      subroutine ftincr(n, npar, par, nv, v, ns, st, np, prop, nf,
     &  field, nout, out)
      implicit none
@include fortran/ftincr_arguments.f
      integer m, nodes, i, k, j, ii, nseg
      parameter (m = 40)
      integer insv(m), lsv(m), ix(m,4), iisv5(m), iseg(m), ilbsv(m)
      integer npc(1), lcfst(1), lcfdt(1), isurf(400,1), nhv, nact, nin
      integer nosl
      real areas(m), none(400), fni(m), d(m,3), ua(np+1), rn(m,3)
      real fdat(5,m), f(m,3), ss(m), tt(m), stfk(m), frc(2,m), pld(2,1)
      real temp(400), ufhist(ns,m), ufeps(1,1)
      character*6 side
      integer itopaz
      common /thropt/ itopaz(101)
      itopaz = 0
      if (par(2) .gt. 0.5D0) itopaz(1) = 999
      nhv = ns
      nact = n
      nin = np
      nodes = 400
      nseg = nint(par(4))
      none = huge(none)
      npc = 0
      lcfst = 0
      lcfdt = 0
      isurf = 0
      pld = 0
      ufeps = 0
      side = 'master'
      do i = 1, np
        ua(i) = real(prop(i), kind(ua))
      end do
C     Values of nodes that are not in contact
      insv = 399
      lsv = nseg
      ix = 398
      iisv5 = m
      ilbsv = m
      iseg = 31
      areas = 1.5
      fni = -3
      d = 0.25
      rn = 0.5
      fdat = -5.25
      f = -5.25
      ss = 0.125
      tt = 0.125
      stfk = 2
      frc = 0.75
      temp = 55
      ufhist = -5.25
      do k = 1, n
        ii = nint(v(21,k))
        iisv5(k) = ii
        lsv(ii) = nint(v(22,k))
        j = nint(v(23,k))
        ilbsv(ii) = j
        insv(ii) = 100 + ii
        fni(ii) = real(v(1,k), kind(fni))
        areas(ii) = real(v(2,k), kind(areas))
        do i = 1, 3
          d(ii,i) = real(v(2+i,k), kind(d))
          rn(ii,i) = real(v(5+i,k), kind(rn))
          fdat(2+i,ii) = real(v(8+i,k), kind(fdat))
          f(ii,i) = 2
        end do
        fdat(1,ii) = 0
        fdat(2,ii) = 0
        stfk(ii) = real(v(12,k), kind(stfk))
        frc(1,lsv(ii)) = real(v(13,k), kind(frc))
        ss(ii) = real(v(14,k), kind(ss))
        tt(ii) = real(v(15,k), kind(tt))
        temp(insv(ii)) = real(v(16,k), kind(temp))
        do i = 1, 4
          ix(ii,i) = 200 + 4*ii + i
          temp(ix(ii,i)) = real(v(16+i,k), kind(temp))
        end do
        do i = 1, ns
          ufhist(i,j) = real(st(i,k), kind(ufhist))
        end do
      end do
      nosl = @{contact}
      call usrfrc(nosl, none, 1, none, insv, areas, none, none, none,
     &  lsv, ix(1,1), ix(1,2), ix(1,3), ix(1,4), none, none, none, none,
     &  none, none, fni, d(1,1), d(1,2), d(1,3), real(par(1), kind(d)),
     &  nin, ua, side, iisv5, nact, rn(1,1), rn(1,2), rn(1,3), none,
     &  none, none, none, none, fdat, iseg, f(1,1), f(1,2), f(1,3), ss,
     &  tt, ilbsv, stfk, frc, nodes, npc, pld, lcfst, lcfdt, temp, none,
     &  none, isurf, nhv, ufhist, 1, ufeps, real(par(3), kind(d)))
      out = 0
      do k = 1, n
        ii = iisv5(k)
        do i = 1, 3
          out(i,k) = f(ii,i)
          out(3+i,k) = fdat(2+i,ii)
          f(ii,i) = -5.25
          fdat(2+i,ii) = -5.25
        end do
        out(7,k) = fdat(1,ii)
        out(8,k) = fdat(2,ii)
        out(9,k) = iseg(ii)
        fdat(1,ii) = -5.25
        fdat(2,ii) = -5.25
        iseg(ii) = 31
        do i = 1, ns
          st(i,k) = ufhist(i,ilbsv(ii))
          ufhist(i,ilbsv(ii)) = -5.25
        end do
      end do
      out(10,1) = count(abs(f + 5.25) .gt. 0)
     &  + count(abs(fdat + 5.25) .gt. 0) + count(iseg .ne. 31)
     &  + count(abs(ufhist + 5.25) .gt. 0)
      end
