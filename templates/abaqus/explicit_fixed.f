@for in in inputs
C     @{in.comment}
      x(@{in.index}) = @{in.fallback}
@if in.is_property
      if (nProps .ge. @{in.property}) then
        x(@{in.index}) = props(@{in.property})
@if in.converts
        x(@{in.index}) = x(@{in.index})@{in.convert}
@end
      end if
@end
@end
