# Cortex-M4F: single-precision floating-point unit; boards almec (STM32F405 class) and mps2-an386.
set(MOREPRO_CPU_FLAGS "-mcpu=cortex-m4 -mfpu=fpv4-sp-d16")
include("${CMAKE_CURRENT_LIST_DIR}/cortex_m.cmake")
