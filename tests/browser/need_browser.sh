# shellcheck shell=bash
# What scripts beside need, or they end as skipped (77).
if ! command -v chromedriver >/dev/null || ! /usr/bin/python3 -c 'import selenium' 2>/dev/null; then
  echo "skipped: needs chromium, chromium-driver and python3-selenium"
  exit 77
fi
