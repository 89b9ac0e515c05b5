# Linux on riscv64, run under user-mode emulation.
set(MOREPRO_ARCH riscv64)
include("${CMAKE_CURRENT_LIST_DIR}/linux_gateway.cmake")
