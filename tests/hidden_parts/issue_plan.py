#!/usr/bin/env python3
"""Writes the plan by which the issue measures a module: long carriers, releases, trains, Emin."""

CARRIER = 56000.0


class Plan:
    def __init__(self):
        self.lines = []
        self.now_ms = 0.0

    def rest(self, ms):
        self.now_ms += ms

    def step(self, on, off, repeats, level_db, carrier=CARRIER):
        self.lines.append(f"{self.now_ms:.6f} {carrier:g} {on} {off} {repeats} {level_db:g}")
        self.now_ms += 1e3 * repeats * (on + off) / carrier


def cycles(ms):
    return round(ms * 1e-3 * CARRIER)


def attack(plan):
    for level in range(0, -64, -8):
        plan.step(cycles(1200), 0, 1, level)
        plan.rest(1800)


def release(plan):
    for weaker in (0, 4, 8, 12, 16, 20):
        plan.step(cycles(1200), 0, 1, -16)
        plan.rest(3.5 - 1e3 * 20 / CARRIER)
        plan.step(20, cycles(3.5) - 20, round(1500 / 3.5), -16 - weaker)
        plan.rest(3000)


def trains(plan):
    for burst in (60, 98, 150, 300, 600):
        for duty in (0.08, 0.11, 0.15, 0.2, 0.27, 0.36, 0.45):
            period = round(burst / duty)
            plan.step(burst, period - burst, max(1, round(cycles(1500) / period)), -38)
            plan.rest(900)


def thresholds(plan, levels, carrier):
    for level in levels:
        plan.step(30, round(10e-3 * carrier) - 30, 30, level, carrier)
        plan.rest(100)


def main():
    plan = Plan()
    attack(plan)
    release(plan)
    trains(plan)
    thresholds(plan, (-40, -43.5, -47, -50.5, -54, -57.5, -61), CARRIER)
    for share in (0.92, 0.96, 1.04, 1.08):
        thresholds(plan, (-38, -43, -47), round(share * CARRIER))
    print("# The issue's plan: start_ms carrier_hz cycles_on cycles_off repeats level_db")
    print("\n".join(plan.lines))


main()
