C     PROPS (PROPERTIES=@{n_props}; a property the deck does not give
C     takes the value in brackets):
C     @{properties...}
C
