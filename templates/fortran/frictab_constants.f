C     States that the solver does not give, in canonical units, by the
C     number of the state (0: the solver gives it).
      block data ftdata
      implicit none
      integer i
@{common}
@{data}
      end
C
