# SPDX-License-Identifier: MIT
"""The recorded sequences by what they show, and which of them are from the same recording."""

from collections.abc import Iterable, Mapping

ALL, UNLISTED = "all", "other"
TUNED = ("Couple", "Crossing", "David", "FaceOcc2", "Football1", "Girl")
PEOPLE = (
    *("BeachRunner", "Bolt", "Couple", "Crossing", "Cyclist", "Diving", "Human3", "Human7", "OneOfGroup"),
    *("RoadUser", "Skiing", "StreetWalker", "Wakeboarder", "WalkerFromAbove", "Woman"),
)
FACES = ("David", "FaceOcc2", "Football1", "Girl", "Jumping")
CARS = ("BlurredCar", "Car1", "CarFromAbove", "NightVehicle")
ANIMALS = ("Gull", "Panda")
OBJECTS = ("Boat", "HandBook", "MotorRolling", "PlasticBag")
OTB_REST = ("Bolt", "Car1", "Diving", "Human3", "Human7", "Jumping", "MotorRolling", "Skiing", "Woman")
DRONES = (
    *("BeachRunner", "Boat", "CarFromAbove", "Gull", "NightVehicle", "OneOfGroup", "Wakeboarder"),
    "WalkerFromAbove",
)
COLOR = (*PEOPLE, *FACES, *CARS, *ANIMALS, *OBJECTS)
REGISTERED = "kitchen-mug", "kitchen-mug chair", "paper-cup", "walker-purple", "yellow-dragon"
WALKERS = "queue-first", "queue-second", "walk-away"
LISTED = (*COLOR, *REGISTERED, *WALKERS)
GROUPS: Mapping[str, frozenset[str]] = {
    "tuned": frozenset(TUNED),  # the parameters of version 0.1.0 were chosen on these
    "others": frozenset(COLOR) - frozenset(TUNED),
    "OTB": frozenset((*TUNED, *OTB_REST)),
    "gray": frozenset(("Car1", "FaceOcc2", "Jumping")),
    "drones": frozenset(DRONES),  # from the air; one, of a car, perhaps from a helicopter
    "people": frozenset(PEOPLE),  # whole bodies, also of riders
    "faces": frozenset(FACES),  # and heads
    "cars": frozenset(CARS),
    "animals": frozenset(ANIMALS),
    "objects": frozenset(OBJECTS),
    "registered": frozenset(REGISTERED),  # with depth, which is registered to color
    "walkers": frozenset(WALKERS),  # with depth, in whose pixels the true boxes are
}
"""A sequence may be in several groups."""
RECORDINGS: Mapping[str, str] = {
    "StreetWalker": "Couple",
    "kitchen-mug chair": "kitchen-mug",
    "queue-second": "queue-first",
    "walker-purple": "queue-first",
}
"""The sequence whose recording a sequence shares, for those that share one."""


def members(sequences: Iterable[str]) -> dict[str, list[str]]:
    """The sequences by group: ALL, those of GROUPS that have any, and UNLISTED for all others."""
    names = list(sequences)
    listed = frozenset[str]().union(*GROUPS.values())
    found = {ALL: names}
    found |= {group: [name for name in names if base(name) in own] for group, own in GROUPS.items()}
    found[UNLISTED] = [name for name in names if base(name) not in listed]
    return {group: own for group, own in found.items() if own}


def recording(sequence: str) -> str:
    """The name that all sequences of one recording share."""
    folder, slash, name = sequence.rpartition("/")
    return f"{folder}{slash}{RECORDINGS.get(name, name)}"


def base(sequence: str) -> str:
    """A sequence's name without its folder's."""
    return sequence.rpartition("/")[2]
