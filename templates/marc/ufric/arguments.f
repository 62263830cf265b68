      subroutine ufric(mibody,coord,fn,vrel,temp,yiel,fric,time,inc,
     &  nsurf)
      implicit none
      integer mibody(4), inc, nsurf
      double precision coord(@{n_coord}), fn, vrel(@{n_slip}), temp(2)
      double precision yiel, fric, time
