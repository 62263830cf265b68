C     VFRICTION for Abaqus/Explicit, general contact (*FRICTION,
C     USER=FRICTION):
@{head}
C     Newer releases say Sec and Main where this says Slv and Mst; the
C     order is the same.
@{arguments}
C
@{body}
@{core}
