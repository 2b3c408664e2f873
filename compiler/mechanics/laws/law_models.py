"""The laws by their names in the catalogue, and their checks."""

from __future__ import annotations

from collections.abc import Mapping

from frot.compiler.mechanics.constraint import Constraint, FrictionBlock
from frot.compiler.mechanics.laws.coulomb import Coulomb
from frot.compiler.mechanics.laws.law import LawModel
from frot.compiler.mechanics.laws.pivoting_resistance import PivotingResistance
from frot.compiler.mechanics.laws.regularized import Regularized
from frot.compiler.mechanics.laws.restitution import Restitution
from frot.compiler.mechanics.laws.rolling_resistance import RollingResistance
from frot.compiler.mechanics.laws.stops import Stops
from frot.compiler.mechanics.laws.stribeck import Stribeck
from frot.compiler.mechanics.laws.user_law import UserLaw
from frot.compiler.mechanics.laws.viscous import Viscous
from frot.compiler.mechanics.unsupported import one_of, refuse
from frot.dsl import Log
from frot.dsl.checked import Law, Liaison

# Those of the catalogue that are not here are refused by name. Elements of friction of a
# constraint stand in the order of this table, whatever the order of the text.
LAW_MODELS: Mapping[str, LawModel] = {
    "coulomb": Coulomb(),
    "stribeck": Stribeck(),
    "rolling_resistance": RollingResistance(),
    "pivoting_resistance": PivotingResistance(),
    "viscous": Viscous(),
    "regularized": Regularized(),
    "restitution": Restitution(),
    "stops": Stops(),
}
_USER_LAW = UserLaw()
# Laws of one slip.
_SLIDING = ("coulomb", "stribeck", "regularized")
# Laws of friction of one liaison: the kernel's FROT_LAWS_OF_CONTACT.
MOST_LAWS = 3


def law_model(law: Law) -> LawModel | None:
    """The model of a law; None where there is none yet."""
    return _USER_LAW if "tangential" in law.arguments else LAW_MODELS.get(law.kind.name)


def acts_while_closed(liaison: Liaison, law: Law) -> bool:
    """Whether the mode of what can part says if a law of it acts: see `LawModel`."""
    model = law_model(law)
    return model is not None and model.acts_while_closed(liaison, law)


def check_laws(liaison: Liaison, planar: bool, known: bool, log: Log) -> None:
    """Report the laws of a liaison that are not supported; `known`: its kind is."""
    for law in liaison.laws:
        model = law_model(law)
        if "gap" in liaison.driven:
            log.report(
                "E0511",
                f"the law '{law.kind.name}' of '{liaison.name}', whose gap is driven: what is "
                "apart has no friction",
                law.span,
                help="leave out the law, or the drive",
            )
        elif model is None:
            refuse(log, f"the law '{law.kind.name}'", law.span, one_of("laws", LAW_MODELS))
        else:
            model.check(liaison, law, planar, known, log)
    _refuse_many(liaison, log)
    sliding = [law for law in liaison.laws if law.kind.name in _SLIDING]
    if len(sliding) > 1:
        log.report(
            "E0511",
            f"liaison '{liaison.name}' with the laws '{sliding[0].kind.name}' and "
            f"'{sliding[1].kind.name}' of one slip",
            sliding[1].span,
            help="leave out one of them",
        )


def _refuse_many(liaison: Liaison, log: Log) -> None:
    """Report more laws of friction than the kernel solves for in one liaison."""
    dry = [law for law in liaison.laws if (model := law_model(law)) is not None and model.is_dry]
    if len(dry) <= MOST_LAWS:
        return
    names = ", ".join(f"'{law.kind.name}'" for law in dry)
    refuse(
        log,
        f"liaison '{liaison.name}' with the laws {names}, more than {MOST_LAWS} of friction,",
        dry[MOST_LAWS].span,
        f"leave out all but {MOST_LAWS}, or give the others to another liaison of the bodies",
    )


def frictions_of(link: Constraint, log: Log) -> tuple[FrictionBlock, ...] | None:
    """The elements of friction of a constraint; None where a law does not fit it."""
    laws = {law.kind.name: law for law in link.liaison.laws}
    found: list[FrictionBlock] = []
    for name, model in LAW_MODELS.items():
        law = laws.get(name)
        if law is None:
            continue
        if not model.fits(link, law, log):
            return None
        found += model.elements(link, law)
    return tuple(found)
