if ! command -v cosys-sim >/dev/null; then
  apt-get -qq update
  if [ -n "${COSYS_SIM_DEB:-}" ]; then
    case $COSYS_SIM_DEB in
      *://*) apt-get -qq -y install ca-certificates curl && curl -fsSL -o cosys-sim.deb "$COSYS_SIM_DEB" ;;
      *) cp "$COSYS_SIM_DEB" cosys-sim.deb ;;
    esac
    apt-get -qq -y install ./cosys-sim.deb
  elif [ -n "${COSYS_SIM_SOURCE:-}" ]; then
    apt-get -qq -y install ca-certificates git
    [ -d .cosys-sim ] || git clone -q "$COSYS_SIM_SOURCE" .cosys-sim
    git -C .cosys-sim checkout -q @COMMIT@
    ln -sf "$PWD/.cosys-sim/cosys-sim" /usr/local/bin/cosys-sim
  else
    echo "no cosys-sim (neither COSYS_SIM_DEB nor COSYS_SIM_SOURCE says where it is) set one of these variables" >&2
    exit 1
  fi
fi
cosys-sim --version
