C     Calls USRBCC as DEFORM-2D does, for the edge between two nodes
C     (see ftdriv in src/codegen/driver.h). States: 1 pressure, 2 speed,
C     3 slip, 4 work, 5 peak pressure, 6 temperature, 7 flow stress,
C     8 surface expansion. A user variable is a history or a field; what
C     it is not is 0.
      subroutine ftdriv(n, ns, v, np, prop, nf, field, nh, hist, tau)
      implicit none
@include fortran/ftdriv_arguments.f
      integer nbcd(2,2), ndie, i, k, nusrn
      double precision rz(2,2), drz(2,2), usrnod(max(nf,3+nh),2)
      double precision temo(2), temc(2)
      double precision tmpenv, tmpslf, sldvel, press
      common /ufhcom/ tmpenv, tmpslf, sldvel, press
      double precision strch, efsts, efeps
      common /ufhcom2/ strch, efsts, efeps
      nusrn = max(nf, 3 + nh)
      nbcd = 0
      ndie = @{contact}
      rz = 0.0D0
      drz = 0.0D0
      temo = 20.0D0
      tmpenv = 20.0D0
      tmpslf = 20.0D0
      efeps = 0.0D0
      do k = 1, n
        press = v(1,k)
        sldvel = v(2,k)
        efsts = v(7,k)
        strch = v(8,k)
        temc = v(6,k)
        usrnod = 0.0D0
        do i = 1, nf
          usrnod(i,1) = field(i,k)
        end do
        do i = 1, 3
          usrnod(i,1) = usrnod(i,1) + v(2+i,k)
        end do
        do i = 1, nh
          usrnod(3+i,1) = usrnod(3+i,1) + hist(i,k)
        end do
        usrnod(:,2) = usrnod(:,1)
        tau(k) = 777.0D0
        call usrbcc(tau(k), 1, 2, 5, nbcd, ndie, rz, drz, usrnod,
     &    nusrn, 20.0D0, temo, temc, 0.0D0, 1, 1, 2, 2)
      end do
      end
C
C     One step of DEFORM (ftincr in src/codegen/driven_path.h): USRBCC
C     for an edge from each node to the next, then USRUPD's call of
C     FTUPD for each node. par: time increment, number of user
C     variables. v, of the edge: pressure, speed, temperatures (2), flow
C     stress, surface expansion; of the node: tangential and normal
C     traction, speed, temperature. out: the result; magnitudes of what
C     calls change that are not for friction, and of other variables.
      subroutine ftincr(n, npar, par, nv, v, ns, st, np, prop, nf,
     &  field, nout, out)
      implicit none
@include fortran/ftincr_arguments.f
      integer nbcd(2,2), ndie, k, nusrn, next
      double precision rz(2,2), drz(2,2), usrnod(nint(par(2)),n), other
      double precision temo(2), temc(2)
      double precision tmpenv, tmpslf, sldvel, press
      common /ufhcom/ tmpenv, tmpslf, sldvel, press
      double precision strch, efsts, efeps
      common /ufhcom2/ strch, efsts, efeps
@if updates
      integer kobj, istatus, kstep, ksstep
      common /usrctl/ kobj, istatus, kstep, ksstep
      double precision dtmaxc
      common /sstu/ dtmaxc
      integer knode, i, j
      double precision rzn(2), urzn(2), drzn(2), tempn, dtmpn
      double precision usrn1(1500), usrn2(1500)
      common /nodcom/ rzn, urzn, drzn, tempn, dtmpn, usrn1, usrn2,
     &  knode
      integer intnal
      double precision arean, tmpneb, spdnod, presr(2)
      common /nodcom2/ arean, tmpneb, spdnod, presr, intnal
@end
      nusrn = nint(par(2))
      usrnod = st(1:nusrn,:)
      nbcd = 3
      ndie = @{contact}
      rz = 1.0D30
      drz = 1.0D30
      temo = 1.0D30
      tmpenv = 1.0D30
      tmpslf = 1.0D30
      efeps = 1.0D30
      do k = 1, n
        next = 1 + mod(k, n)
        press = v(1,k)
        sldvel = v(2,k)
        temc = v(3:4,k)
        efsts = v(5,k)
        strch = v(6,k)
        out(1,k) = 0.125D0
        call usrbcc(out(1,k), k, next, 5, nbcd, ndie, rz, drz, usrnod,
     &    nusrn, 1.0D30, temo, temc, 0.5D0, 4, 1, 2, 2)
        other = 0.125D0
        call usrbcc(other, k, next, 5, nbcd, ndie, rz, drz, usrnod,
     &    nusrn, 1.0D30, temo, temc, 0.5D0, 4, 2, 2, 2)
        call usrbcc(other, k, next, 5, nbcd, ndie, rz, drz, usrnod,
     &    nusrn, 1.0D30, temo, temc, 0.5D0, 4, 1, 1, 2)
        out(2,k) = abs(other - 0.125D0)
      end do
@if updates
      kobj = 1
      kstep = 9
      ksstep = 3
      intnal = 6
      arean = 1.0D30
      tmpneb = 1.0D30
      dtmpn = 1.0D30
      dtmaxc = par(1)
      do k = 1, n
        usrn1 = 0.625D0
        do i = 1, ns
          usrn1(i) = st(i,k)
        end do
        presr(1) = v(7,k)
        presr(2) = v(8,k)
        spdnod = v(9,k)
        tempn = v(10,k)
C       Calls that are no end of a step, or of no node, change nothing.
        usrn2 = usrn1
        knode = k
        istatus = 0
        call ftupd
        istatus = 1
        knode = 0
        call ftupd
        do i = 1, 1500
          out(2,k) = out(2,k) + abs(usrn2(i) - usrn1(i))
        end do
        knode = k
        call ftupd
        do i = 1, ns
          st(i,k) = usrn2(i)
        end do
        do j = ns + 1, 1500
          out(2,k) = out(2,k) + abs(usrn2(j) - 0.625D0)
        end do
      end do
@end
      end
