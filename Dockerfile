# docker build -t frictab . && docker run --rm -v "$PWD:/work" -u "$(id -u)" frictab run job.toml
# Debian's libraries, of the release that the results were made with: the same bytes everywhere.
# .ci/pin renews the image's digest.
FROM debian:12@sha256:8a8cd02c5912770b4980228a54d4aff9e4f986f1eb2525d2d371dec5232cefcc AS build
COPY apt-packages.txt /frictab/
RUN apt-get update -q && sed '/^# tests/,$d; /^#/d' /frictab/apt-packages.txt | \
    DEBIAN_FRONTEND=noninteractive xargs apt-get install -q -y --no-install-recommends git dpkg-dev file
COPY . /frictab
WORKDIR /frictab
# The copy belongs to another user than root's git expects.
RUN git config --global --add safe.directory /frictab && \
    cmake --preset release && cmake --build --preset release && \
    cpack --config build/release/CPackConfig.cmake -B /packages

FROM debian:12@sha256:8a8cd02c5912770b4980228a54d4aff9e4f986f1eb2525d2d371dec5232cefcc
COPY --from=build /packages/frictab_*.deb /packages/
# With the compilers that verify calls.
RUN apt-get update -q && \
    DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends \
      /packages/frictab_*.deb gcc gfortran libc6-dev && \
    rm -rf /packages /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["frictab"]
