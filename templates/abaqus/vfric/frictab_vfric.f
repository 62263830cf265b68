C     VFRIC for Abaqus/Explicit, contact pairs (*FRICTION, USER):
@{head}
C     Names are those of releases 2022 and later; older ones differ, in
C     the same order.
@{arguments}
C
@{body}
@{core}
