@for constant in constants
@if constant.renamed
  /* @{constant.comment} */
@end
  const double @{constant.name} = @{constant.value};
@end
