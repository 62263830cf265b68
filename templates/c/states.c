@for input in used
@if input.converted
  const double @{input.name} = @{input.canonical};
@end
@end
@include c/constants.c
