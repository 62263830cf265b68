C     Calls USRBCC as DEFORM-2D does, for the edge between two nodes
C     (see ftdriv in src/codegen/driver.h). States: 1 pressure, 2 speed,
C     3 slip, 4 work, 5 peak pressure, 6 temperature, 7 flow stress,
C     8 surface expansion. A user variable is a history or a field; what
C     it is not is 0.
      subroutine ftdriv(n, ns, v, np, prop, nf, field, nh, hist, tau)
      implicit none
      integer*4 n, ns, np, nf, nh
      real*8 v(ns,n), prop(np), field(nf,n), hist(nh,n), tau(n)
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
