"""Dynamic waves of an ocean object: a function of the sea's time, not of the times shown before.

A simulation is computed tick by tick from its start, where the water is flat
(tools/events/event_player.hpp). States are kept, so that a jump back continues from the last one
before it."""
import dataclasses
import math
import typing

from . import events, library
from .typed_numbers import typed

longest_replay_s = 3600
kept_bytes = 256 << 20  # of the states of one simulation
border_per_side = 0.1875  # as the command line has it


class WavesKey(typing.NamedTuple):
    """All that a simulation depends on."""
    grid: typing.Any  # pelagic.DynamicWavesOptions
    center: tuple  # x, z in metres
    rain: typing.Any  # pelagic.Rain
    start_s: float  # of rain
    events_name: str
    events_text: str


players = {}


def key_of(settings, sea, start_s):
    """Returns the key of the simulation, or None if there are neither events nor rain. Raises
    ValueError with one line."""
    text = settings.events.as_string() if settings.events else ""
    if not text and not settings.rain > 0:
        return None
    pelagic = library.pelagic
    side = typed(settings.waves_side)
    grid = pelagic.DynamicWavesOptions(resolution=int(settings.waves_resolution), side_m=side,
                                       border_m=side * border_per_side, depth_m=sea.depth_m)
    rain = pelagic.Rain()
    if settings.rain > 0:
        rain = pelagic.Rain(typed(settings.rain), typed(settings.rain_radius), typed(settings.rain_depth))
    place = [typed(coordinate) for coordinate in settings.place]
    return WavesKey(grid, (place[0], -place[1]), rain, start_s if settings.rain > 0 else 0.0,
                    settings.events.name if text else "", text)


def state_at(key, time_s):
    """Returns the saved state of the last tick at a time. Raises ValueError with one line."""
    if key not in players:
        players[key] = Player(key)
    return players[key].state_at(time_s)


class Player:
    """One simulation and its kept states."""

    def __init__(self, key):
        self.rate = key.grid.ticks_per_s
        self.events = events.parse(key.events_name, key.events_text) if key.events_text else ()
        self.commands = events.commands(self.events, self.rate)
        starts = [self.commands[0][0] - 1] if self.commands else []
        if key.rain.drops_per_m2_s > 0:
            starts.append(self.tick_at(key.start_s))
        self.tick = min(starts)
        # The smallest sea: only its dynamic waves are used.
        sea = dataclasses.replace(library.pelagic.Sea(), resolution=16, patch_size_m=16)
        self.ocean = library.pelagic.Ocean(sea, queries=False, dynamic_waves=key.grid)
        self.waves = self.ocean.dynamic_waves
        self.waves.set_center(*key.center)
        self.waves.set_rain(key.rain)
        self.ocean.frame_at(self.time_of(self.tick))
        self.next_command, self.numbers = 0, {}
        self.kept = {}  # by tick
        self.spacing = self.rate  # ticks between kept states
        self.keep()
        self.first_tick = self.tick
        self.most_kept = max(4, min(64, kept_bytes // len(self.kept[self.tick][0])))

    def tick_at(self, time_s):
        return math.floor(time_s * self.rate + 2 ** -16)  # dynamic_waves.cpp

    def time_of(self, tick):
        return tick / self.rate

    def keep(self):
        self.kept[self.tick] = self.waves.save_state(), self.next_command, dict(self.numbers)

    def state_at(self, time_s):
        tick = max(self.tick_at(time_s), self.first_tick)
        if self.time_of(tick - self.first_tick) > longest_replay_s:
            raise ValueError(f"Dynamic waves start at {self.time_of(self.first_tick):g} s and the frame is "
                             f"at {time_s:g} s: must be at most {longest_replay_s} s later")
        nearest = max(kept for kept in self.kept if kept <= tick)
        if tick < self.tick or nearest > self.tick:
            saved, self.next_command, numbers = self.kept[nearest]
            self.tick, self.numbers = nearest, dict(numbers)
            self.waves.restore_state(saved)
        self.go_to(tick)
        return self.waves.save_state()

    def go_to(self, tick):
        while self.tick < tick:
            while self.next_command < len(self.commands) and self.commands[self.next_command][0] == self.tick + 1:
                self.run(*self.commands[self.next_command])
                self.next_command += 1
            until = min(tick, self.tick + self.rate // 2, (self.tick // self.spacing + 1) * self.spacing)
            if self.next_command < len(self.commands):
                until = min(until, self.commands[self.next_command][0] - 1)
            self.ocean.frame_at(self.time_of(until))
            self.tick = until
            if until % self.spacing == 0:
                self.keep()
                self.thin()

    def run(self, tick, adds, index):
        event = self.events[index]
        if not adds:
            self.waves.remove_source(self.numbers.pop(index))
        elif event.duration_s == 0:
            self.waves.add_impulse(event.disturbance)
        else:
            source, since_s = event.disturbance, self.time_of(tick) - event.time_s
            self.numbers[index] = self.waves.add_source(dataclasses.replace(
                source, x_m=max(-1e8, min(1e8, source.x_m + since_s * source.velocity_x_mps)),
                z_m=max(-1e8, min(1e8, source.z_m + since_s * source.velocity_z_mps))))

    def thin(self):
        if len(self.kept) <= self.most_kept:
            return
        self.spacing *= 2
        self.kept = {tick: kept for tick, kept in self.kept.items()
                     if tick % self.spacing == 0 or tick == self.first_tick}
