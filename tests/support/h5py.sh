# shellcheck shell=sh
# Sets $python to a Python that has h5py; where there is none the test is skipped. The Python of the system is asked for first: it is the
# one whose packages script/install-deps installs.
for python in /usr/bin/python3 python3; do
    if "$python" -c 'import h5py, numpy' 2>/dev/null; then break; fi
    python=
done
[ -n "$python" ] || { echo "skipped: no Python with h5py"; exit 77; }
