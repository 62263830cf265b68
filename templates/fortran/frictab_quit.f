C     Ends the analysis.
      subroutine ftquit(text)
      implicit none
      character*(*) text
      write (*, '(1x,a)') trim(text)
      flush (6)
      @{statement}
      end
C
