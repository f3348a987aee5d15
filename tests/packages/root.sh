# root.sh, sourced with $root, a fresh root: makes $root/trial, with /proc and /dev there, until the script ends.
((EUID == 0)) || { echo "only root can change its root"; exit 77; }
for name in proc dev; do mount --bind "/$name" "$root/$name"; done
leave_root() {
  umount "$root/proc" "$root/dev"
  rm -rf "$root/trial"
}
trap leave_root EXIT
mkdir "$root/trial"
