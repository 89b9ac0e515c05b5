# What every Cortex-M build shares; cortex_m4f.cmake and cortex_m7.cmake set MOREPRO_CPU_FLAGS and include this.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES MOREPRO_BOARD)

set(MOREPRO_BOARD_FLAGS "${MOREPRO_CPU_FLAGS} -mthumb -mfloat-abi=hard --specs=picolibc.specs")
set(CMAKE_C_FLAGS_INIT "${MOREPRO_BOARD_FLAGS} -ffunction-sections -fdata-sections")
set(CMAKE_CXX_FLAGS_INIT "${CMAKE_C_FLAGS_INIT} -fno-exceptions -fno-rtti -fno-threadsafe-statics")
# -O3: the monitor takes a sixth fewer instructions than with -O2, for 20 KB of flash; -Os makes Eigen 2 to 9 times
# slower.
# Set, not ..._INIT: to that CMake would append its own -O3.
set(CMAKE_C_FLAGS_RELEASE "-O3 -DNDEBUG" CACHE STRING "Flags of release builds")
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG" CACHE STRING "Flags of release builds")

# Headers only come from the host's packages (Eigen); libraries and programs of the host are of no use here.
set(CMAKE_PREFIX_PATH /usr)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)

set(MOREPRO_QEMU_MACHINE_almec netduinoplus2)
set(MOREPRO_QEMU_MACHINE_mps2-an386 mps2-an386)
set(MOREPRO_QEMU_MACHINE_mps2-an500 mps2-an500)
set(MOREPRO_QEMU_MACHINE "${MOREPRO_QEMU_MACHINE_${MOREPRO_BOARD}}")
set(CMAKE_CROSSCOMPILING_EMULATOR
  "qemu-system-arm;-M;${MOREPRO_QEMU_MACHINE};-display;none;-monitor;none;-serial;null;-semihosting-config;enable=on,target=native;-kernel")
