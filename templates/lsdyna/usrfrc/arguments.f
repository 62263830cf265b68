      subroutine usrfrc(nosl,time,ncycle,dt2,insv,areas,xs,ys,zs,
     &  lsv,ix1,ix2,ix3,ix4,aream,xx1,xx2,xx3,stfn,stf,fni,
     &  dx,dy,dz,fdt2,ninput,ua,side,iisv5,niisv5,rn1,rn2,rn3,fric1,
     &  fric2,fric3,fric4,bignum,fdat,iseg,fxis,fyis,fzis,ss,tt,
     &  ilbsv,stfk,frc,numnp,npc,pld,lcfst,lcfdt,temp,temp_bot,
     &  temp_top,isurface,nhv,ufhist,neps,ufeps,sfacn3)
      implicit none
      integer nosl, ncycle, ninput, niisv5, numnp, nhv, neps
      integer insv(*), lsv(*), ix1(*), ix2(*), ix3(*), ix4(*)
      integer iisv5(*), iseg(*), ilbsv(*), npc(*), lcfst(*), lcfdt(*)
      integer isurface(numnp,*)
      real time, dt2, fdt2, fric1, fric2, fric3, fric4, bignum, sfacn3
      real areas(*), xs(*), ys(*), zs(*), aream(*), xx1(*), xx2(*)
      real xx3(*), stfn(*), stf(*), fni(*), dx(*), dy(*), dz(*), ua(*)
      real rn1(*), rn2(*), rn3(*), fdat(5,*), fxis(*), fyis(*), fzis(*)
      real ss(*), tt(*), stfk(*), frc(2,*), pld(2,*), temp(*)
      real temp_bot(*), temp_top(*), ufhist(nhv,*), ufeps(neps,*)
      character*(*) side
