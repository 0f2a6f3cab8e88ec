# SPDX-License-Identifier: MIT
"""Every exported kernel, with valid arguments of which some were changed, beside pages that nobody may touch.

A kernel returns, or raises ValueError or TypeError. A crash ends the tests; the case is then in a file of
their temporary folder.
``make fuzz`` tries more cases.
"""

import os
import time
from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import numpy as np
import pytest
from tricue import _core

from tests.fuzz.mutations import guard, mutate
from tests.fuzz.recorded_calls import Calls, kernel_names, record_calls

CASES = int(os.environ.get("TRICUE_FUZZ", "50"))
SECONDS = 20.0  # of one call
ALLOWED = (ValueError, TypeError)
LEAST, MOST = -(2**31), 2**31 - 1
ENDS = [(LEAST, LEAST, MOST, MOST), (MOST, MOST, LEAST, LEAST), (MOST,), (LEAST,)]
"""Of int; the first corners of a region are as far apart as can be."""


@pytest.fixture(scope="module")
def calls() -> Calls:
    """Valid arguments of each kernel."""
    return record_calls()


def test_every_kernel_is_recorded(calls: Calls) -> None:
    """It proves that no kernel is left out below."""
    assert set(calls) == set(kernel_names())


@pytest.mark.parametrize("name", kernel_names())
def test_a_kernel_answers_or_refuses(
    name: str, calls: Calls, tmp_path_factory: pytest.TempPathFactory
) -> None:
    """It proves that no arguments make a kernel touch what isn't its own, hang, or fail in another way."""
    kernel = getattr(_core, name)
    current = tmp_path_factory.getbasetemp() / f"{name}.case"
    refused = 0
    for case in range(CASES):
        random = np.random.default_rng([case, *name.encode()])
        arguments, keywords = changed(calls[name][case % len(calls[name])], random)
        current.write_text(str(case))
        before = time.perf_counter()
        try:
            kernel(*arguments, **keywords)
        except ALLOWED as error:
            refused += bool(str(error))
        seconds = time.perf_counter() - before
        assert seconds < SECONDS, f"{name}, case {case}: {seconds:.0f} s"
    assert 0 < refused < CASES


@pytest.mark.parametrize("name", kernel_names())
def test_a_kernel_multiplies_nothing_unchecked(name: str, calls: Calls) -> None:
    """It proves that whole numbers whose products no integer holds, one of them, an argument's or all at
    once, are refused or don't matter: where they are multiplied all the same, ``make sanitize`` stops.
    """
    kernel = getattr(_core, name)
    for arguments, keywords in calls[name]:
        given: dict[Any, Any] = {**dict(enumerate(arguments)), **keywords}
        for ends in ENDS:
            other = {place: at_ends(value, ends) for place, value in given.items()}
            single = [(place, one) for place, value in given.items() for one in one_at_end(value, ends[0])]
            for changes in [other, *({place: value} for place, value in [*other.items(), *single])]:
                held = given | changes
                positional = [held.pop(place) for place in range(len(arguments))]
                with suppress(*ALLOWED):
                    kernel(*positional, **held)


def at_ends(value: Any, ends: tuple[int, ...]) -> Any:
    """A whole number, or those of a tuple, in turn at the ends of int; anything else as it is."""
    if isinstance(value, tuple):
        return tuple(at_ends(each, ends[i % len(ends) :]) for i, each in enumerate(value))
    return ends[0] if is_whole(value) else value


def one_at_end(value: Any, end: int) -> Iterator[Any]:
    """A tuple with one of its whole numbers at an end of int, for each of them."""
    for i, each in enumerate(value) if isinstance(value, tuple) else ():
        for other in [end] if is_whole(each) else one_at_end(each, end):
            yield (*value[:i], other, *value[i + 1 :])


def is_whole(value: Any) -> bool:
    """Whether it is a whole number."""
    return isinstance(value, int | np.integer) and not isinstance(value, bool)


def changed(call: tuple[tuple[Any, ...], dict[str, Any]], random: np.random.Generator) -> Any:
    """The arguments of a call of which one is changed, or two or three."""
    arguments, keywords = list(call[0]), dict(call[1])
    places: list[Any] = [*range(len(arguments)), *keywords]
    for _ in range(int(random.choice([1, 1, 1, 2, 3]))):
        place = places[int(random.integers(len(places)))]
        held: Any = arguments if isinstance(place, int) else keywords
        held[place] = mutate(held[place], random)
    return (
        tuple(guard(each, random) for each in arguments),
        {name: guard(each, random) for name, each in keywords.items()},
    )
