# Sourced by the scripts that a newcomer starts: packages that are missing, and quiet commands.

# quietly NAME COMMAND...: the output is shown only where the command fails.
quietly() {
  local name="$1" log
  shift
  log="$(mktemp)"
  if "$@" >"$log" 2>&1; then
    rm -f -- "$log"
    return 0
  fi
  cat -- "$log" >&2
  rm -f -- "$log"
  echo "$0: $name failed; the output is above" >&2
  exit 1
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi
}

# Names of what is installed, what installed packages stand in for included (a nodejs that brings its own npm).
installed_names() {
  dpkg-query -W -f '${db:Status-Status} ${Package}, ${Provides}\n' | sed -n 's/^installed //p' | tr ', ' '\n\n' | sort -u
}

# install_missing FILE...: Debian packages, one a line.
install_missing() {
  command -v dpkg-query >/dev/null || return 0
  local missing=()
  mapfile -t missing < <(cat -- "$@" | grep -v '^#' | sort -u | comm -23 - <(installed_names))
  [ "${#missing[@]}" -gt 0 ] || return 0
  echo "Installing ${missing[*]} ..." >&2
  quietly "apt-get update" as_root env DEBIAN_FRONTEND=noninteractive apt-get update
  quietly "apt-get install" as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends "${missing[@]}"
}
