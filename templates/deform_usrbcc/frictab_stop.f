C     Ends the simulation after the friction routine's message. A file
C     of its own, so that another way to end can take its place.
      subroutine ftquit
      implicit none
      stop 'friction table: a state is outside the range'
      end
