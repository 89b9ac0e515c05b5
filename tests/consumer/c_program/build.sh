#!/bin/sh
# build.sh PROGRAM: a C program with an installed MOREPRO. No C++ compiler, no C++ library, no Eigen.
set -eu
here="$(dirname -- "$0")"
# shellcheck disable=SC2046 # flags are words
${CC:-cc} -std=c99 -pedantic -Wall -Wextra -Werror -I "$here/.." $(pkg-config --cflags morepro) \
  "$here/main.c" $(pkg-config --libs morepro) -o "$1"
