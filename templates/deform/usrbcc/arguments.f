      subroutine usrbcc(variable,node1,node2,ielem,nbcd,ndie,rz,
     &  drz,usrnod,nusrn,envtem,temo,temc,curtim,model,imode,itype,
     &  nurz)
      implicit none
      integer node1, node2, ielem, ndie, nusrn, model, imode, itype
      integer nurz, nbcd(nurz,2)
      double precision variable, rz(2,2), drz(nurz,2)
      double precision usrnod(nusrn,*), envtem, temo(2), temc(2)
      double precision curtim
