#!/bin/sh
# build.sh MOREPRO EIGEN PROGRAM: MOREPRO without any build system. MOREPRO: the checkout, EIGEN: the folder that holds
# Eigen/Core. What matters: C++20, -ffp-contract=off for the same bits as everywhere, and no errno from square roots.
set -eu
here="$(dirname -- "$0")"
morepro="$1"
eigen="$2"
program="$3"
for source in lib/c/morepro_monitor lib/c/morepro_plant lib/c/morepro_text lib/monitor/reason; do
  ${CXX:-c++} -std=c++20 -O2 -DNDEBUG -ffp-contract=off -fno-math-errno -fno-exceptions -fno-rtti \
    -I "$morepro" -isystem "$eigen" -c "$morepro/$source.cpp" -o "$program.$(basename "$source").o"
done
${CC:-cc} -std=c99 -I "$morepro/lib/c" -I "$here/.." "$here/../c_program/main.c" "$program".*.o -lm -o "$program"
