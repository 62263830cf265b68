@for in in inputs
C       @{in.comment}
        if (@{in.exists}) then
          x(@{in.index}) = @{in.first}
@if in.has_second
          if (@{in.second_exists}) then
            comp = @{in.second}
            x(@{in.index}) = 0.5D0*(x(@{in.index}) + comp)
          end if
@end
@if in.converts
          x(@{in.index}) = x(@{in.index})@{in.convert}
@end
        else
          x(@{in.index}) = @{in.fallback}
@if in.has_property
          if (nProps .ge. @{in.property})
     &      x(@{in.index}) = props(@{in.property})
@end
        end if
@end
