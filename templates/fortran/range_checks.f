@if has_ends
      logical ftout
      external ftout
@end
@if refuses
      logical ftstop
      external ftstop
@end
