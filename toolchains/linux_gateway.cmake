# What the builds for Linux edge gateways share; the including file sets MOREPRO_ARCH.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR "${MOREPRO_ARCH}")
set(CMAKE_C_COMPILER "${MOREPRO_ARCH}-linux-gnu-gcc")
set(CMAKE_CXX_COMPILER "${MOREPRO_ARCH}-linux-gnu-g++")
set(CMAKE_FIND_ROOT_PATH "/usr/${MOREPRO_ARCH}-linux-gnu")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
# Header-only packages of the host (Eigen) serve every architecture.
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE BOTH)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)
set(CMAKE_CROSSCOMPILING_EMULATOR "qemu-${MOREPRO_ARCH};-L;/usr/${MOREPRO_ARCH}-linux-gnu")
