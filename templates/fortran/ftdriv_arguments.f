      integer*4 n, ns, np, nf, nh
      real*8 v(ns,n), prop(np), field(nf,n), hist(nh,n), tau(n)
