@for input in held
  const double @{input.name} =
      @{input.value};
@end
@include c/constants.c
