"""Where published figures come from, and how far each can be trusted."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

Mark = Literal["V", "V2", "M", "E", "C"]
MARKS: Mapping[Mark, str] = MappingProxyType(
    {
        "V": "read in the source",
        "V2": "second-hand: read in notes that cite it",
        "M": "from memory: check before quoting",
        "E": "an estimate of ours, no published value",
        "C": "computed for this project",
    }
)
"""How a figure was come by, in words."""


@dataclass(frozen=True, slots=True)
class Source:
    """A paper, a book, or a decision of this project."""

    short: str
    """as it is cited in a row"""
    full: str
    """as it stands in a list of references"""


SOURCES: Mapping[str, Source] = MappingProxyType(
    {
        "autesserre": Source(
            "Autesserre 1989",
            "Autesserre, D., Nishinuma, Y., Guaïtella, I. (1989). Breathing, pausing, and speaking in dialogue. "
            "Eurospeech 1989, 2433-2436.",
        ),
        "bernardet": Source(
            "Winkworth 1995 in Bernardet 2019",
            "Bernardet, U., Kang, S., Feng, A., DiPaola, S., Shapiro, A. (2019). Speech Breathing in Virtual Humans: "
            "An "
            "Interactive Model and Empirical Study. It quotes Winkworth et al. (1995) for the length of breath groups.",
        ),
        "henderson": Source(
            "Henderson 1965",
            "Henderson, A., Goldman-Eisler, F., Skarbek, A. (1965). Temporal patterns of cognitive activity and breath "
            "control in speech. Language and Speech 8.",
        ),
        "hixon": Source(
            "Hixon 1973",
            "Hixon, T. J., Goldman, M. D., Mead, J. (1973). Kinematics of the chest wall during speech production: "
            "volume "
            "displacements of the rib cage, abdomen, and lung. Journal of Speech and Hearing Research 16.",
        ),
        "hixon_hoit": Source(
            "Hixon & Hoit 2005",
            "Hixon, T. J., Hoit, J. D. (2005). Evaluation and Management of Speech Breathing Disorders.",
        ),
        "hoit": Source(
            "Hoit & Hixon 1987",
            "Hoit, J. D., Hixon, T. J. (1987). Age and speech breathing. Journal of Speech and Hearing Research 30.",
        ),
        "jacewicz": Source(
            "Jacewicz 2009",
            "Jacewicz, E., Fox, R. A., O'Neill, C., Salmons, J. (2009). Articulation rate across dialect, age, and "
            "gender. "
            "Language Variation and Change 21.",
        ),
        "korean": Source(
            "read Korean 2008",
            "The study of breath group based on oral airflow in reading by healthy speakers (2008), 18 women of 20 to "
            "30 "
            "years reading Korean, JAKO200804748556267.",
        ),
        "mcfarland": Source(
            "McFarland 2001",
            "McFarland, D. H. (2001). Respiratory markers of conversational interaction. Journal of Speech, Language, "
            "and "
            "Hearing Research 44:128-143. With Rochet-Capellan & Fuchs (2013) and Huber & Darling (2011).",
        ),
        "papers": Source(
            "Bernardet 2017, 2019",
            "Bernardet, U., Kang, S., Feng, A., DiPaola, S., Shapiro, A. (2017). A Dynamic Speech Breathing System for "
            "Virtual Characters. Intelligent Virtual Agents; and (2019), Speech Breathing in Virtual Humans.",
        ),
        "pajupuu": Source(
            "Pajupuu & Kerge 2006",
            "Pajupuu, H., Kerge, K. (2006), on pauses in Estonian read aloud: news by a professional, fiction by an "
            "actor "
            "(ceeol 235225).",
        ),
        "rochet": Source(
            "Rochet-Capellan & Fuchs 2013",
            "Rochet-Capellan, A., Fuchs, S. (2013). The interplay of linguistic structure and breathing in German "
            "spontaneous speech. Interspeech 2013, 2014-2018.",
        ),
        "scorebreath": Source(
            "scorebreath",
            "This project's own windows: the defaults and the acceptance numbers of docs/sources.md (physiology 1.4, "
            "3.2, "
            "3.5 and 10), in line with the papers where those give directions only.",
        ),
        "textbook": Source(
            "textbooks",
            "Textbook and class values of the cycle: 10/90 or 0.16 in speech against 40/60 or 0.45 at rest.",
        ),
        "tobin": Source(
            "Tobin 1983",
            "Tobin, M. J., et al. (1983). Breathing patterns. 1. Normal subjects. Chest 84.",
        ),
        "trouvain": Source(
            "Trouvain 2016",
            "Trouvain, J., Fauth, C., Möbius, B. (2016). Breath and non-breath pauses in fluent and disfluent phases "
            "of "
            "German and French L1 and L2 read speech. Speech Prosody 2016.",
        ),
        "wang": Source(
            "Wang 2010",
            "Wang, Y.-T., Green, J. R., Nip, I. S. B., Kent, R. D., Kent, J. F. (2010). Breath group analysis for "
            "reading "
            "and spontaneous speech in healthy adults. Folia Phoniatrica et Logopaedica 62:297-302.",
        ),
        "whalen": Source(
            "Whalen & Kinsella-Shaw 1994",
            "Whalen, D. H., Kinsella-Shaw, J. M. (1994). Exploring the relationship of breath intake to utterance "
            "duration. 128th Meeting of the Acoustical Society of America, 4pSP8; in full: Phonetica 54:138-152 "
            "(1997).",
        ),
        "winkworth94": Source(
            "Winkworth 1994",
            "Winkworth, A. L., Davis, P. J., Ellis, E., Adams, R. D. (1994). Variability and consistency in speech "
            "breathing during reading. Journal of Speech and Hearing Research 37:535-556.",
        ),
        "winkworth95": Source(
            "Winkworth 1995",
            "Winkworth, A. L., Davis, P. J., Adams, R. D., Ellis, E. (1995). Breathing patterns during spontaneous "
            "speech. "
            "Journal of Speech and Hearing Research 38:124-144.",
        ),
    }
)
"""Every source, by the key that rows cite."""
