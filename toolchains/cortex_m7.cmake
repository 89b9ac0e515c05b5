# Cortex-M7: double-precision floating-point unit; board mps2-an500.
set(MOREPRO_CPU_FLAGS "-mcpu=cortex-m7 -mfpu=fpv5-d16")
include("${CMAKE_CURRENT_LIST_DIR}/cortex_m.cmake")
