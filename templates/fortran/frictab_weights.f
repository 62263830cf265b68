@for feature in features
      double precision wt@{feature.index}(@{units})
@end
      double precision bias(@{units}), gain(@{units}), offs(@{outputs})
@for feature in features
      save wt@{feature.index}
@end
      save bias, gain, offs
@for feature in features
@{feature.data}
@end
@{data_bias}
@{data_gain}
@{data_offs}
