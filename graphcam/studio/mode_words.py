"""What the page says in its teaching modes."""

from collections.abc import Mapping

from graphcam.words import Caption, say, say_in

MODE_WORDS: Mapping[str, Caption] = {
    "locked": say("Sizes and values are locked in this mode."),
    "predict_what": say("What do you predict?"),
    "predict_how": say(
        "Move the dashed amber mark to where you expect it: drag it, use the arrow keys, or type the number below."
    ),
    "guess": say("Your guess"),
    "guess_along": say("Your guess, along its line"),
    "guess_across": say("Your guess, across"),
    "guess_down": say("Your guess, down"),
    "construct": say("Construct"),
    "construct_next": say("Next step (→)"),
    "try_again": say("Try again"),
    "next_variant": say("Next variant"),
    "on_paper": say("on paper"),
    "of_the_machine": say("of the machine"),
    "nothing_to_predict": say("This task has nothing to predict: choose another one in Play mode."),
    "constructing": say("The construction, step by step: {step}", step="{step}"),
    "tours": say("Tours"),
    "card_of": say("Card {card} of {cards}", card="{card}", cards="{cards}"),
    "all_tours": say("All tours"),
    "right": say("Right."),
    "not_right": say("Not that one. Try another answer."),
    "done_it": say("Done."),
    "do_it": say("Or try it in the drawing; the card will notice."),
    "do_it_only": say("Do it in the drawing or with the sizes; the card will notice."),
    "finish_tour": say_in("a tour", "Finish"),
    "next_card": say_in("a tour", "Next card"),
    "previous_card": say_in("a tour", "Previous card"),
    "seen": say_in("a tour", "seen"),
    "no_exercise": say("There is no exercise here. Open the link that came with your handout."),
    "check": say("Check"),
    "answers": say("Answers"),
    "answer_right": say_in("an answer", "right"),
    "answer_wrong": say_in("an answer", "not right"),
    "not_a_number": say("Write a number."),
    "draw_it": say("Draw it and hand it in with your answers; it is not checked here."),
    "decimals": say("decimals: {count}", count="{count}"),
    "no_checks": say("Answers are not checked here. Hand them in as your course says."),
    "practice": say("For practice only: marks are given for what you hand in."),
    "checked": say("{right} of {checked} right.", right="{right}", checked="{checked}"),
}
"""Captions by the names that ``predict.js``, ``tour.js`` and ``exercise.js`` ask for."""
