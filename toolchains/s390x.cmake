# Linux on s390x (big-endian), run under user-mode emulation.
set(MOREPRO_ARCH s390x)
include("${CMAKE_CURRENT_LIST_DIR}/linux_gateway.cmake")
