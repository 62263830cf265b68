@if cubic
      integer fc(@{n_cells})
      double precision tb(@{n_basis})
      save fc, tb
@end
      double precision un(@{n_nodes}), pc(@{n_cells})
      double precision tv(@{n_values})
@if in_file
      common /ftvals/ tv
      save un, pc
@else
      save un, pc, tv
@end
@if uses_guide
      integer gd(@{n_guide})
      save gd
@end
C     nodes (logarithms on logarithmic axes), 1/width of cells
@{data_un}
@{data_pc}
@if uses_guide
C     cells by the coordinate's place
@{data_gd}
@end
@if cubic
C     per cell: first coefficient; 4 polynomials of the cell's weight
@{data_fc}
@{data_tb}
@end
C     @{value_comment}
@if in_file
C     in /ftvals/, from @{file}
@else
@{data_tv}
@end
