# Protections that stop an overflow or an overwritten pointer, as Debian's hardening=+all. No flag
# changes a number.
include(CheckCXXCompilerFlag)
target_compile_options(frictab_flags INTERFACE -fPIE -Wformat -Werror=format-security)
target_link_options(frictab_flags INTERFACE -pie -Wl,-z,relro -Wl,-z,now)
# -D_FORTIFY_SOURCE needs an optimiser, which not every configuration has.
set(OPTIMISED $<CONFIG:Release,RelWithDebInfo,MinSizeRel>)
set(FORTIFIED 2)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12)
  set(FORTIFIED 3)
endif()
target_compile_options(frictab_flags INTERFACE
  $<${OPTIMISED}:-fstack-protector-strong>
  $<${OPTIMISED}:-U_FORTIFY_SOURCE> $<${OPTIMISED}:-D_FORTIFY_SOURCE=${FORTIFIED}>)
foreach(flag -fstack-clash-protection -fcf-protection) # not for every processor
  string(MAKE_C_IDENTIFIER "FRICTAB_HAVE${flag}" known)
  check_cxx_compiler_flag(${flag} ${known})
  if(${known})
    target_compile_options(frictab_flags INTERFACE $<${OPTIMISED}:${flag}>)
  endif()
endforeach()
