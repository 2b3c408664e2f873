"""Codes of faults found after the text was read: initial values, tools, the run."""

from __future__ import annotations

from collections.abc import Mapping

from frot.dsl.messages.codes_writing import Row, snippet

_BALL = "body ball: particle(mass = 1 kg);"
_ROD = (
    "body bar: rod(mass = 1 kg, length = 2 m);\n"
    "liaison tip: contact_ponctuel(ground.line, bar.start) with coulomb(1.6), restitution(0);"
)

TOOLS: Mapping[str, Row] = {
    "E0601": (
        "contradictory initial values",
        "The initial statements cannot hold together, or not with the liaisons. "
        "The statements in conflict are named.",
        "Take one of them away, or make it a guess.",
        snippet(_BALL, "ball.position = (0, 0) m;\nball.position.x = 1 m;"),
    ),
    "E0602": (
        "initial statement that finds nothing",
        "The liaisons already fix every quantity in this statement, so that it can be neither "
        "imposed nor chosen; or it is on an acceleration or a reaction that is known only when "
        "the state is, because friction or a contact that parts decides it.",
        "Take it away, or state positions and velocities.",
        snippet(_BALL, "ground.position = (1, 0) m;"),
    ),
    "E0801": (
        "no C compiler",
        "The equations are compiled before they run. No compiler was found in FROT_CC, as 'cc' or "
        "in the package 'ziglang'.",
        "Install a C compiler, or 'pip install ziglang', or set FROT_CC.",
        "",
    ),
    "E0802": (
        "the C compiler failed",
        "The generated program was refused by the compiler; its first messages are in the notes. "
        "If the compiler works on other files, this is a fault of Frot.",
        "Check FROT_CC and the free space of the disc; report the message otherwise.",
        "",
    ),
    "E0803": (
        "cannot write a file",
        "The file or its folder cannot be written.",
        "Check the path, the permissions and the free space.",
        "",
    ),
    "E0804": (
        "cannot read a file",
        "The file does not exist, is a folder, may not be read, or is not a text in UTF-8.",
        "Check the path; save the file with the encoding UTF-8.",
        "",
    ),
    "E0805": (
        "unknown parameter",
        "A value was given to a parameter or an input that the model does not have.",
        "Write one of the names that the note lists.",
        "",
    ),
    "E0806": (
        "bad value of an option",
        "The value of an option or of a parameter cannot be read, or has another dimension.",
        "Write a number in SI, or a number and a unit in quotes: --set 'r=12 mm'.",
        "",
    ),
    "E0807": (
        "no FMU can be made",
        "The model or this platform has something that FMI cannot express, or FMPy found a fault "
        "in the archive. Nothing was written.",
        "Name a file that ends in .fmu; report the message if the fault is in the archive.",
        "",
    ),
    "E0808": (
        "not enough memory",
        "The system gave no more memory: what the command was to make is too large for it.",
        "Choose fewer output times, an earlier stop time or a smaller model.",
        "",
    ),
    "E0809": (
        "an FMU cannot be checked",
        "The file is no FMU, or FMPy could not run it on this machine.",
        "Look at what the message says; export the model anew.",
        "",
    ),
    "E0820": (
        "nothing to draw, or nothing to draw it with",
        "A page is drawn by the Python package k3d, a film .mp4 by ffmpeg; one of them is not "
        "installed, or the model has no bodies.",
        "Install what the message names, or write another format; 'frot plot' draws curves.",
        "",
    ),
    "E0821": (
        "bad values of an input over time",
        "The values of an input over time are no function of time with jumps: a column is missing, "
        "times go back, a number is missing, a unit has another dimension, or the run is longer.",
        "Write (times, values) with ascending times, or --input F=file.csv:column.",
        "",
    ),
    "E0822": (
        "a second run went another way",
        "A reaction that a run did not compute is found by a second run with it. Small differences "
        "grow in this motion, so that the two end at different places.",
        "Declare the reaction as an output of the model, and run that.",
        "",
    ),
    "E0901": (
        "fault in the run",
        "The motion could not be computed past the time named.",
        "Look at what the message names at that time, and at the last events before it.",
        "",
    ),
    "E0902": (
        "impasse",
        "No motion is compatible with the laws of friction at this instant (Painlevé 1895), or "
        "several are and the experiment asks to stop there. No contact is pressed by its friction, "
        "or the experiment says 'on_impasse = stop': the run ends there and keeps its motion.",
        "Choose a smaller coefficient of friction, or 'on_indeterminate = rest'.",
        snippet(
            _ROD,
            "bar.angle = 63 deg;\nbar.start.position = (0, 0) m;\n"
            "bar.start.velocity = (-1, 0) m/s;",
            "  experiment(stop = 1 s, on_impasse = stop);\n",
        ),
    ),
    "E0903": (
        "chattering",
        "More events follow one another than time can resolve, and no rest was found at their "
        "limit.",
        "Look at the liaisons of the last events.",
        "",
    ),
    "E0904": (
        "not a number",
        "An expression has no value in the course of the motion: a division by zero, a root of a "
        "negative number.",
        "Correct the expression named, or keep the motion away from there.",
        "",
    ),
    "E0905": (
        "impact not resolved",
        "Figures that touch meet at a second place, where their liaison does not hold them, or no "
        "impulses satisfy the laws of the contacts that meet. The run keeps its motion so far.",
        "Two bodies may touch at two places by two liaisons, each of a figure of its own; else "
        "another coefficient, or an earlier end of the run.",
        "",
    ),
    "E0906": (
        "an assertion does not hold",
        "An 'assert' among the equations came to be false; its message is given.",
        "Look at what leads there; 'level = warning' reports it and continues.",
        "",
    ),
    "E0909": (
        "event that cannot be",
        "An event of the text cannot do what it says: two 'reinit's give one state two values at "
        "one instant, or the ticks of a 'sample' lie closer than time can tell apart.",
        "Join the 'when's with 'elsewhen', which says which comes first; sample less often.",
        "",
    ),
    "E0910": (
        "a loop in a singular posture",
        "The loop that the liaison closes comes to a posture in which its relations depend on each "
        "other, as a parallelogram that is flat. A motion that passes goes straight on, and one "
        "that begins there goes the way that its speeds say; one that is or comes to rest there, "
        "or passes so slowly that rounding decides, could go on in several ways. The run ends "
        "there and keeps its motion.",
        "State or guess the speeds that say the way, give it more speed there, begin beside it, or "
        "keep it away from there by a stop or by other lengths.",
        "",
    ),
    "E0911": (
        "a figure without a tangent or a normal",
        "Where the liaison stands, the slope of its curve or surface is zero, as in a cusp or in "
        "the apex of a cone, or no place of it is the nearest, as in the centre of a sphere: "
        "nothing tells in which direction it acts. Or two figures bend alike where they "
        "are nearest, as a wheel in a curve of its own radius: nothing tells where they touch. "
        "Lines that meet while they are parallel, as two rods, have no common normal; nor has a "
        "line in the plane of a rim.",
        "State or guess another place, keep the motion away from there, or give the figure another "
        "form: a parameter that grows as its length does. A rim that lies on a plane is an "
        "`appui_faces`, and so are edges of faces. A cylinder touches what a rod cannot.",
        snippet(
            "curve wire on ground: parametric((1 m*u^3, 1 m*u^2), u = (-1, 1));\n"
            "body bead: particle(mass = 1 kg);\n"
            "liaison guide: point_courbe(bead, wire);",
            "guide.u = 0;",
        ),
    ),
    "E0912": (
        "an index that changes with a branch",
        "One branch of an equation holds the unknown that it is solved for, and the branch that is "
        "taken does not: it relates states, and would have to be differentiated. Equations are "
        "differentiated as often in all branches.",
        "Write in that branch the derivative of what it says, and let the values agree where it is "
        "entered.",
        snippet(
            "Real x, y, f;\nBoolean free = time > 1 s;",
            "x = 0; y = 0;",
            "equation\n  der(x) = (1 - f)*1 1/s;\n  der(y) = f*1 1/s;\n"
            "  if free then\n    f = 0;\n  else\n    y = x;\n  end if;\n",
        ),
    ),
    "E0907": (
        "equations without a solution",
        "The equations named do not determine their unknowns at this instant: no solution was "
        "found near the last values, or there is more than one.",
        "Give start values near the solution, or keep the motion away from there.",
        "",
    ),
    "E0908": (
        "a change in a run is refused",
        "A parameter or an input that is changed in a run takes effect at once, but no body is "
        "moved at once: the change would put a body into a line, take apart a liaison that cannot "
        "part, or carry a body along with its pin, its line or a relation of the text. The old "
        "values stay, and the run can go on. A 'reinit' that would do so ends the run.",
        "Make the change before the start. A contact that can part opens where its line is taken "
        "away, so let what is lowered be able to part; let the text move a support as a function "
        "of time.",
        "// refused in a run, while the ball rests: setting h to 1 mm\n"
        "planar model Raised\n"
        "  parameter Length h = 0 m;\n"
        "  body ball: particle(mass = 1 kg);\n"
        "  curve floor on ground: line(through = (0 m, h), direction = (1, 0));\n"
        "  liaison support: contact_ponctuel(ball, floor);\n"
        "end Raised;\n",
    ),
}
