      integer*4 n, npar, nv, ns, np, nf, nout
      real*8 par(npar), v(nv,n), st(ns,n), prop(np), field(2*nf,n)
      real*8 out(nout,n)
