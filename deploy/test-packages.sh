#!/usr/bin/env bash
# Installs packages into a bare Debian and uses them there: deploy/test-packages.sh FOLDER-WITH-DEBS [SUITE [MIRROR]]
#
# Client and server render; the example builds against the library; and where systemd-nspawn is there, the machine is booted
# and its service serves, starts again, reloads and drains. Needs root, debootstrap and a mirror.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
debs=$(realpath "${1:?"Usage: test-packages.sh FOLDER-WITH-DEBS [SUITE [MIRROR]]"}")
suite=${2:-bookworm}
mirror=(${3:+"$3"})  # debootstrap knows one itself

place=$(mktemp -d)
root=$place/root
nspawn=
finish() {
    if [[ -n $nspawn ]]; then
        kill -TERM "$nspawn" 2> /dev/null || true
        wait "$nspawn" || true
    fi
    umount "$root/proc" 2> /dev/null || true
    rm -rf --one-file-system "$place"
}
trap finish EXIT
inside() { LC_ALL=C DEBIAN_FRONTEND=noninteractive chroot "$root" "$@"; }
quietly() {
    "$@" > "$place/log" 2>&1 || {
        tail -n 30 "$place/log" >&2
        return 1
    }
}

quietly debootstrap --variant=minbase "$suite" "$root" "${mirror[@]}"
mount -t proc proc "$root/proc"
cp "$debs"/*.deb "$root/tmp/"
cp -r "$here/../scenes" "$here/example" "$root/tmp/"
echo "a bare Debian $(cat "$root/etc/debian_version"), $(inside dpkg --get-selections | wc -l) packages"

# shellcheck disable=SC2016 # The shell inside expands it.
quietly inside sh -c 'apt-get install -y --no-install-recommends /tmp/antipode_*.deb /tmp/antipode-server_*.deb mesa-vulkan-drivers'
inside antipode --version
inside antipode devices
options=(/tmp/scenes/pool.textproto --width 48 --height 32 --iterations 4 --quiet --no-error)
inside antipode render "${options[@]}" -o /tmp/alone.exr --stats /tmp/alone.json
# Not by the function: the signal is to meet the server, not a shell.
chroot "$root" antipode-server --listen 127.0.0.1:17300 --cache /tmp/cache --quiet &
server=$!
inside antipode render "${options[@]}" --server 127.0.0.1:17300 --wait 60 -o /tmp/farm.exr --stats /tmp/farm.json
kill -TERM "$server"
wait "$server"
hash() { grep -o '"sums_sha256": "[0-9a-f]*"' "$root/tmp/$1.json"; }
[[ $(hash alone) == "$(hash farm)" ]]
echo "alone and on a server: $(hash farm)"

quietly inside sh -c 'apt-get install -y --no-install-recommends /tmp/libantipode-dev_*.deb cmake g++ make'
quietly inside sh -c 'cmake -S /tmp/example -B /tmp/build && cmake --build /tmp/build && /tmp/build/example /tmp/sphere.png'
echo "the library's example wrote $(stat -c %s "$root/tmp/sphere.png") bytes"
umount "$root/proc"

type -P systemd-nspawn > /dev/null || { echo "SKIPPED: there is no systemd-nspawn to boot it with"; exit 0; }
quietly inside apt-get install -y --no-install-recommends systemd systemd-sysv dbus
inside systemd-sysusers
mkdir -p "$root/etc/credstore"
(umask 077 && head -c 32 /dev/urandom | base64 > "$root/etc/credstore/antipode-server.secret")
cp "$root/etc/credstore/antipode-server.secret" "$root/tmp/secret"
cat > "$root/etc/default/antipode-server" << 'SETTINGS'
ANTIPODE_SERVER_LISTEN=0.0.0.0:17301
ANTIPODE_SERVER_PSK_FILE=/run/credentials/antipode-server.service/antipode-server.secret
ANTIPODE_SERVER_LOG_FORMAT=json
SETTINGS
inside systemctl enable antipode-server 2> /dev/null
# The machine shares the network, and needs no systemd on this machine.
systemd-nspawn --quiet --boot --directory="$root" --machine="antipode-$$" --register=no --keep-unit --console=pipe \
    > "$place/boot" 2>&1 < /dev/null &
nspawn=$!
client() {
    inside antipode render "${options[@]}" --server 127.0.0.1:17301 --psk-file /tmp/secret --wait "$1" -o /tmp/unit.exr \
        --stats /tmp/unit.json
}
client 60
[[ $(hash alone) == "$(hash unit)" ]]
echo "on the booted machine's service: $(hash unit)"
leader=$(pgrep --parent "$nspawn" | tail -n 1)
within() { nsenter --target "$leader" --all "$@"; }
within systemctl show antipode-server --property=ActiveState,DynamicUser,NRestarts
within systemd-analyze security antipode-server --no-pager | tail -n 1
within sh -c 'kill -KILL "$(systemctl show antipode-server --property=MainPID --value)"'
sleep 8
client 60
within systemctl show antipode-server --property=ActiveState,NRestarts
within systemctl reload antipode-server
client 60
within systemctl stop antipode-server
within systemctl show antipode-server --property=ActiveState,Result
within journalctl --unit=antipode-server --output=cat --no-pager | grep '^{' | sed 's/"time":"[^"]*"/"time":"…"/'
