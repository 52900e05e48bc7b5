# shellcheck shell=bash
# What scripts beside need, or they end as skipped (77).
if ! command -v chromedriver >/dev/null || ! /usr/bin/python3 -c 'import selenium' 2>/dev/null; then
  exec "$(dirname "${BASH_SOURCE[0]}")/../skip.sh" browser "needs chromium, chromium-driver and python3-selenium"
fi
