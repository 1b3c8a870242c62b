# A Debian 12 that has nothing else, in a folder; sourced by scripts that set `root`, the tree, and `fail MESSAGE`.
# It needs root, debootstrap and Debian's mirror (SPHC_DEBIAN_MIRROR names another one).
place=$root/build/bare_root
debian=$place/debian.tar

check_machine() {
  [ "$(id -u)" = 0 ] || fail "only root can change the root folder; run it as root"
  command -v debootstrap >/dev/null || fail "debootstrap is missing; toolchains/install_packages.sh bare_root installs it"
}

# The system, once: $debian is there whole or not at all.
make_debian() {
  [ -f "$debian" ] && return
  local made=$place/made
  rm -rf "$made"
  mkdir -p "$made"
  debootstrap --variant=minbase bookworm "$made" "${SPHC_DEBIAN_MIRROR:-http://deb.debian.org/debian}" >"$place/debootstrap.log" 2>&1 ||
    { tail -n 20 "$place/debootstrap.log" >&2 && fail "debootstrap failed; $place/debootstrap.log has all of what it said"; }
  tar -C "$made" -cf "$debian.part" .
  rm -rf "$made"
  mv "$debian.part" "$debian"
}

# bare FOLDER: the system, with the tree as git knows it in /src, edits included.
bare() {
  local tree
  tree=$(git -C "$root" stash create)
  rm -rf "$1"
  mkdir -p "$1/src"
  tar -C "$1" -xf "$debian"
  cp /etc/resolv.conf "$1/etc/resolv.conf"
  git -C "$root" archive "${tree:-HEAD}" | tar -C "$1/src" -x
}

# in_bare FOLDER SCRIPT: runs a line of bash in it, in namespaces of its own, so that mounts and processes end with it.
in_bare() {
  # shellcheck disable=SC2016 # for the shell inside
  unshare --mount --pid --fork --kill-child bash -euc '
    mount -t proc proc "$1/proc"
    mount --rbind /dev "$1/dev"
    exec chroot "$1" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
      bash -euc "$2"' in_bare "$1" "$2" </dev/null
}
