      subroutine fric(lm,tau,ddtddg,ddtddp,dslip,sed,sfd,
     1 ddtddt,pnewdt,statev,dgam,taulm,press,dpress,ddpddh,slip,
     2 kstep,kinc,time,dtime,noel,ciname,slname,msname,npt,node,
     3 npatch,coords,rcoord,drot,temp,predef,nfdir,mcrd,npred,
     4 nstatv,chrlngth,props,nprops)
C
      include 'aba_param.inc'
C
      character*80 ciname,slname,msname
      dimension tau(nfdir),ddtddg(nfdir,nfdir),ddtddp(nfdir),
     1 dslip(nfdir),ddtddt(nfdir,2),statev(*),dgam(nfdir),
     2 taulm(nfdir),slip(nfdir),time(2),coords(mcrd),
     3 rcoord(mcrd),drot(2,2),temp(2),predef(2,*),props(nprops)
