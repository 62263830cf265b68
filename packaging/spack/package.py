from spack.package import *


class Frictab(CMakePackage):
    """Friction laws: tribometer data to a verified subroutine for finite-element codes."""

    # Replace by the address of the release archive (cpack, CPackSourceConfig.cmake).
    url = "file:///path/to/frictab-0.2.0.tar.gz"
    license("MIT")

    # Spack asks for the archive's SHA-256: version("0.2.0", sha256="...")
    version("0.2.0")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    for library in ("cli11", "eigen", "fmt", "gsl", "hdf5", "libzip", "matio", "nanoflann",
                    "nlohmann-json", "nlopt", "pcre2", "pugixml", "tbb", "tomlplusplus",
                    "udunits", "xxhash", "zlib-api"):
        depends_on(library)
    generator("ninja")

    def cmake_args(self):
        return ["-DFRICTAB_TESTS=OFF", "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=16"]
