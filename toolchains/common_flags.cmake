# Flags that decide what the numbers are, and the warnings of our own code. Both stay ours: other projects get
# -ffp-contract=off where they compile our headers (toolchains/package.cmake), and nothing else.
# -ffp-contract=off: one rounding per operation, so that every machine gives the same bits.
# -fno-math-errno, -fno-trapping-math: let loops be vectorised; they change no result.
set(MOREPRO_NUMBER_FLAGS -ffp-contract=off -fno-math-errno -fno-trapping-math)
set(MOREPRO_WARNINGS -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror)
if(NOT PROJECT_IS_TOP_LEVEL)
  return()
endif()
add_library(morepro_flags INTERFACE)
target_compile_options(morepro_flags INTERFACE ${MOREPRO_NUMBER_FLAGS} ${MOREPRO_WARNINGS})

option(MOREPRO_AVX2 "Use AVX2 on hosts that have it (the bits stay the same)" ON)
if(MOREPRO_AVX2 AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64" AND NOT CMAKE_CROSSCOMPILING)
  include(CheckCXXSourceRuns)
  check_cxx_source_runs("int main() { return __builtin_cpu_supports(\"avx2\") && __builtin_cpu_supports(\"fma\") ? 0 : 1; }" MOREPRO_HOST_HAS_AVX2)
  if(MOREPRO_HOST_HAS_AVX2)
    target_compile_options(morepro_flags INTERFACE -march=x86-64-v3)
  endif()
endif()
