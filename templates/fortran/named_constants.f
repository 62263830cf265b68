@for constant in constants
      double precision @{constant.name}
@if constant.renamed
C     @{constant.comment}
@end
@{constant.statement}
@end
