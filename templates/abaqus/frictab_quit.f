C     Ends the analysis with a message, in which % would stand for
C     something.
      subroutine ftquit(text)
      include '@{include}'
      character*(*) text
      character*500 line
      character*8 charv(1)
      dimension intv(1), realv(1)
      line = text
      do i = 1, 500
        if (line(i:i) .eq. '%') line(i:i) = ' '
      end do
      intv(1) = 0
      realv(1) = 0
      charv(1) = ' '
      call @{routine}(-3, line, intv, realv, charv)
      return
      end
C
