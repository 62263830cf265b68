C     True where x lies beyond a side with outside = error: then the
C     analysis stops with a message that names the state. By more
C     than a millionth of the end's value: single precision misses an
C     end by rounding.
      logical function ftstop(x)
      include '@{include}'
      double precision x(@{n_x}), bad
      character*500 text
      character*60 name
      character*8 charv(1)
      dimension intv(1), realv(1)
      logical ftnan
      external ftnan
      ftstop = .false.
      bad = 0.0D0
      name = ' '
      do i = 1, @{n_x}
        if (ftnan(x(i))) return
      end do
@for side in refusing
      if (x(@{side.index}) @{side.relation} @{side.limit}) then
        ftstop = .true.
        bad = x(@{side.index})
        name =
     &  '@{side.name}'
      end if
@end
      if (.not. ftstop) return
      write (text, '(a,1p,e14.6,a,a)') 'friction table: state', bad,
     &  ' is outside the range: ', name
      intv(1) = 0
      realv(1) = 0
      charv(1) = ' '
      call @{routine}(-3, text, intv, realv, charv)
      return
      end
C
